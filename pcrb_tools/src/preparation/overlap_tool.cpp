#include <algorithm>
#include <filesystem>
#include <iostream>
#include <numeric>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "common/tool_main.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/problem/overlap.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"
#include "preparation/overlap_journal.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools {
namespace {

std::vector<std::size_t> targetPositions(const SequenceFolder& folder,
                                         const std::vector<std::string>& names) {
  std::vector<std::size_t> positions(folder.clouds.size());
  std::iota(positions.begin(), positions.end(), 0);
  if (names.empty()) return positions;
  positions.clear();
  for (const std::string& name : names) positions.push_back(positionOf(folder, name));
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

pcrb::OverlapJob makeJob(const SequenceFolder& folder, const OverlapOptions& options) {
  pcrb::OverlapJob job;
  for (const std::string& name : folder.clouds) job.files.push_back(folder.cloud(name));
  job.distance = options.distance
                     ? *options.distance
                     : pcrb::loadDataset(folder.root, folder.data_set).overlap_distance;
  job.window = options.window;
  job.targets = targetPositions(folder, options.targets);
  job.threads = options.threads;
  return job;
}

/// The right to make a matrix, of one process at a time; leaves no file behind.
class MatrixLock {
 public:
  explicit MatrixLock(const std::string& path) : path_(path + ".lock"), lock_(path_) {
    if (lock_.isHeld()) return;
    throw pcrb::InvalidFile(
        path, 0, "another compute_overlap at work on it (" + lock_.holder() + ")", "one at a time");
  }
  ~MatrixLock() {
    std::error_code ignored;  // the next one takes what is left
    std::filesystem::remove(path_, ignored);
  }
  MatrixLock(const MatrixLock&) = delete;
  MatrixLock& operator=(const MatrixLock&) = delete;

 private:
  std::string path_;
  pcrb::FileLock lock_;
};

pcrb::DerivedFile describeMatrix(const std::string& path, const SequenceFolder& folder,
                                 const pcrb::OverlapJob& job) {
  pcrb::DerivedFile matrix(path, "compute_overlap");
  matrix.setParameter("distance", pcrb::formatShortest(job.distance));
  matrix.setParameter("window", std::to_string(job.window));
  std::string targets;
  if (job.targets.size() < job.files.size()) {
    for (const std::size_t target : job.targets) targets += folder.clouds[target] + " ";
  }
  matrix.setParameter("targets", targets.empty() ? "all" : targets);
  for (const std::string& file : job.files) matrix.addInput(file);
  return matrix;
}

void setColumn(pcrb::OverlapMatrix& matrix, std::size_t target, const std::vector<double>& column) {
  for (std::size_t source = 0; source < column.size(); ++source) {
    if (source != target) matrix.at(source, target) = column[source];
  }
}

/// Takes what the journal knows and takes it off the job.
void resume(const OverlapJournal& journal, pcrb::OverlapMatrix& matrix, pcrb::OverlapJob& job) {
  for (const auto& [target, column] : journal.known()) setColumn(matrix, target, column);
  const auto is_known = [&](std::size_t target) { return journal.known().count(target) > 0; };
  job.targets.erase(std::remove_if(job.targets.begin(), job.targets.end(), is_known),
                    job.targets.end());
}

pcrb::OverlapMatrix computeMatrix(const SequenceFolder& folder, pcrb::OverlapJob job,
                                  OverlapJournal& journal) {
  pcrb::OverlapMatrix matrix(folder.clouds);
  const std::size_t pairs = countPairs(job);
  resume(journal, matrix, job);
  Progress progress(folder.sequence, "pairs", pairs);
  progress.keep(pairs - countPairs(job));
  pcrb::OverlapEvents events;
  events.column_done = [&](std::size_t target, const std::vector<double>& column) {
    journal.append(target, column);
    setColumn(matrix, target, column);
    const auto known = std::count_if(column.begin(), column.end(), [](double v) { return v == v; });
    progress.add(static_cast<std::size_t>(known) - 1);
    Interruption::check();
  };
  computeOverlaps(job, events);
  progress.finish();
  return matrix;
}

}  // namespace

void runOverlapTool(const OverlapOptions& options) {
  SequenceFolder folder = openSequenceFolder(options.folder);
  exclude(folder, options.excluded);
  const std::string path =
      options.output.empty() ? folder.sibling(folder.sequence + "_overlap.txt") : options.output;
  const pcrb::OverlapJob job = makeJob(folder, options);
  const pcrb::DerivedFile output = describeMatrix(path, folder, job);
  const std::string journal_path = path + ".partial";
  const MatrixLock lock(path);
  if (isKept(output, options.force)) {
    std::filesystem::remove(journal_path);  // a kill may have come before its end
    return;
  }
  OverlapJournal journal(journal_path, output.text(), folder.clouds.size());
  const pcrb::OverlapMatrix matrix = computeMatrix(folder, job, journal);
  output.begin();
  writeOverlapMatrix(path, matrix);
  output.record();
  journal.remove();
}

}  // namespace pcrb_tools
