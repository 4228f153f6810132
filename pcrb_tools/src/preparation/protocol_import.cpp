#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "common/tool_main.hpp"
#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/overlap.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// One run of the tool.
class ProtocolImport {
 public:
  explicit ProtocolImport(const ProtocolOptions& options)
      : options_(options),
        folder_(openSequenceFolder(options.folder)),
        dataset_(pcrb::loadDataset(folder_.root, folder_.data_set)),
        rows_(pcrb::parseEthProtocol(pcrb::FileBytes(options.protocol).text(), options.protocol)) {}

  void run(std::ostream& out) {
    const pcrb::DerivedFile output = describe();
    if (isKept(output, options_.force)) return;
    readViewpoints();
    computePairs();
    const std::vector<pcrb::Problem> problems = makeProblems();
    output.begin();
    pcrb::writeProblemFile(output.path(), problems);
    output.record();
    out << output.path() << ": " << problems.size() << " problems of " << overlaps_.size()
        << " pairs from " << rows_.size() << " rows" << std::endl;
  }

 private:
  using Pair = std::pair<std::string, std::string>;  ///< source and target

  Pair pairOf(const pcrb::EthProtocolRow& row) const {
    return {requireCloud(row.reading), requireCloud(row.reference)};
  }

  std::string requireCloud(const pcrb::EthScanName& scan) const {
    std::string name = pcrb::ethCloudName(scan.number);
    positionOf(folder_, name);
    return name;
  }

  pcrb::DerivedFile describe() const {
    pcrb::DerivedFile file(options_.output, "import_protocol");
    file.setParameter("overlap_distance", pcrb::formatShortest(dataset_.overlap_distance));
    file.addInput(options_.protocol);
    for (const std::string& name : folder_.clouds) file.addInput(folder_.cloud(name));
    return file;
  }

  void readViewpoints() {
    for (const auto& row : rows_) {
      const auto [source, target] = pairOf(row);
      overlaps_[{source, target}] = 0.0;
      if (row.reading.frame == pcrb::EthFrame::kGlobal) continue;
      for (const std::string& name : {source, target}) {
        if (viewpoints_.count(name) > 0) continue;
        const auto viewpoint = pcrb::readViewpoint(folder_.cloud(name));
        if (!viewpoint) {
          throw pcrb::InvalidFile(folder_.cloud(name), 0, "no VIEWPOINT",
                                  "the scanner's pose, as the protocol is about scans in their own "
                                  "frames (convert with pose_scanner_leica.csv)");
        }
        viewpoints_.emplace(name, *viewpoint);
      }
    }
  }

  void computePairs() {
    pcrb::OverlapJob job;
    for (const std::string& name : folder_.clouds) job.files.push_back(folder_.cloud(name));
    job.distance = dataset_.overlap_distance;
    job.threads = options_.threads;
    for (std::size_t i = 0; i != folder_.clouds.size(); ++i) {
      const auto is_target = [&](const auto& pair) {
        return pair.first.second == folder_.clouds[i];
      };
      if (std::any_of(overlaps_.begin(), overlaps_.end(), is_target)) job.targets.push_back(i);
    }
    Progress progress(fs::path(options_.output).filename().string(), "targets", job.targets.size());
    pcrb::OverlapEvents events;
    events.column_done = [&](std::size_t target, const std::vector<double>& column) {
      Interruption::check();
      for (auto& [pair, overlap] : overlaps_) {
        if (pair.second != folder_.clouds[target]) continue;
        overlap = column[positionOf(folder_, pair.first)];
      }
      progress.add();
    };
    pcrb::computeOverlaps(job, events);
    progress.finish();
  }

  pcrb::Transform perturbationOf(const pcrb::EthProtocolRow& row, const Pair& pair) const {
    if (row.reading.frame == pcrb::EthFrame::kGlobal) return row.T_reference_reading;
    pcrb::Transform P = viewpoints_.at(pair.second) * row.T_reference_reading *
                        viewpoints_.at(pair.first).inverse();
    P.linear() = pcrb::nearestRotation(P.linear());
    return P;
  }

  std::vector<pcrb::Problem> makeProblems() const {
    constexpr std::size_t kIdsPerPair = 31;
    const std::size_t pairs = rows_.size() / kIdsPerPair + 1;  // enough ids for all rows
    std::vector<pcrb::Problem> problems;
    std::set<std::pair<Pair, std::string>> seen;
    for (const auto& row : rows_) {
      const Pair pair = pairOf(row);
      pcrb::Problem problem;
      problem.source = pair.first;
      problem.target = pair.second;
      problem.overlap = overlaps_.at(pair);
      problem.perturbation = perturbationOf(row, pair).matrix().topRows<3>();
      std::string entries;
      for (Eigen::Index i = 0; i != problem.perturbation.size(); ++i) {
        pcrb::appendShortest(entries, problem.perturbation(i));
        entries += ' ';
      }
      if (!seen.emplace(pair, entries).second) continue;
      problem.id = pcrb::problemId(folder_.sequence, problems.size(), pairs);
      problems.push_back(std::move(problem));
    }
    return problems;
  }

  const ProtocolOptions& options_;
  SequenceFolder folder_;
  pcrb::Dataset dataset_;
  std::vector<pcrb::EthProtocolRow> rows_;
  std::map<std::string, pcrb::Transform> viewpoints_;
  std::map<Pair, double> overlaps_;
};

}  // namespace

void runProtocolImport(const ProtocolOptions& options, std::ostream& out) {
  const Interruption interruption;
  ProtocolImport(options).run(out);
}

}  // namespace pcrb_tools
