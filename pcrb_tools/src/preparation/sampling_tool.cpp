#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "common/tool_main.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/parallel.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kMapSequence = "planetary_map";

/// Centroids of the clouds that have been asked for, read in parallel.
class Centroids {
 public:
  explicit Centroids(const SequenceFolder& folder, int threads)
      : folder_(folder), threads_(threads) {}

  void read(const std::vector<pcrb::CloudPair>& pairs) {
    std::set<std::string> names;
    for (const pcrb::CloudPair& pair : pairs) {
      if (centroids_.count(pair.source) == 0) names.insert(pair.source);
    }
    const std::vector<std::string> missing(names.begin(), names.end());
    if (missing.empty()) return;
    std::vector<Eigen::Vector3d> found(missing.size());
    Progress progress(folder_.sequence, "clouds", missing.size());
    pcrb::parallelFor(missing.size(), threads_, [&](std::size_t i) {
      const std::string path = folder_.cloud(missing[i]);
      const pcrb::DatasetCloud cloud = pcrb::readPcd(path);
      if (cloud.points.empty()) throw pcrb::InvalidProblem(path + ": cloud has no points");
      found[i] = centroid(cloud);
      progress.add();
      Interruption::check();
    });
    progress.finish();
    for (std::size_t i = 0; i < missing.size(); ++i) centroids_[missing[i]] = found[i];
  }

  Eigen::Vector3d operator()(const std::string& source) const { return centroids_.at(source); }

 private:
  const SequenceFolder& folder_;
  int threads_;
  std::map<std::string, Eigen::Vector3d> centroids_;
};

/// One run of the tool: a folder, its overlaps, its data set's parameters.
class Sampling {
 public:
  explicit Sampling(const SamplingOptions& options)
      : options_(options),
        folder_(openSequenceFolder(options.folder)),
        dataset_(pcrb::loadDataset(folder_.root, folder_.data_set, options.bounds)),
        matrix_path_(options.overlap.empty() ? folder_.sibling(folder_.sequence + "_overlap.txt")
                                             : options.overlap),
        matrix_(pcrb::readOverlapMatrix(matrix_path_)),
        centroids_(folder_, options.threads) {
    for (const std::string& name : matrix_.names) positionOf(folder_, name);
    if (!options.map.empty()) mapPosition();
  }

  void run() {
    for (const pcrb::Kind kind : options_.kinds) makeList(kind);
  }

 private:
  std::string sequence() const {
    if (!options_.sequence.empty()) return options_.sequence;
    return options_.map.empty() ? folder_.sequence : kMapSequence;
  }

  void makeList(pcrb::Kind kind) {
    const pcrb::DerivedFile output = describeList(kind);
    if (isKept(output, options_.force)) return;
    const pcrb::ProblemList list{sequence(), kind, drawPairs(kind), dataset_.bounds(kind)};
    centroids_.read(list.pairs);
    output.begin();
    writeProblemFile(output.path(), sampleProblems(list, options_.seed, centroids_));
    output.record();
    report(output.path(), list);
  }

  pcrb::DerivedFile describeList(pcrb::Kind kind) const {
    const auto range = [](const pcrb::Range& r) {
      return pcrb::formatShortest(r.min) + " " + pcrb::formatShortest(r.max);
    };
    pcrb::DerivedFile file(folder_.sibling(sequence() + "_" + std::string(toString(kind)) + ".txt"),
                           "sample_problems");
    file.setParameter("seed", std::to_string(options_.seed));
    file.setParameter("sequence", sequence());
    file.setParameter("kind", toString(kind));
    file.setParameter("translation_m", range(dataset_.bounds(kind).translation));
    file.setParameter("rotation_deg", range(dataset_.bounds(kind).rotation_deg));
    file.setParameter("map", options_.map);
    // Not where it is as ever: files of older versions stay up to date.
    if (options_.top_up == pcrb::TopUp::kPaper) file.setParameter("top_up", "paper");
    std::string excluded;
    for (const std::string& name : options_.excluded) excluded += name + " ";
    file.setParameter("excluded", excluded);
    file.addInput(matrix_path_);
    for (const std::string& name : matrix_.names) file.addInput(folder_.cloud(name));
    return file;
  }

  /// A map that is not asked for is no scan.
  bool isExcluded(const std::string& name) const {
    return (options_.map.empty() && name == pcrb::kMapCloud) ||
           std::count(options_.excluded.begin(), options_.excluded.end(), name) > 0;
  }

  std::vector<pcrb::CloudPair> drawPairs(pcrb::Kind kind) const {
    if (!options_.map.empty()) return pairsWithMap();
    std::vector<pcrb::CloudPair> eligible = pcrb::eligiblePairs(matrix_, kind);
    eligible.erase(std::remove_if(eligible.begin(), eligible.end(),
                                  [&](const pcrb::CloudPair& pair) {
                                    return isExcluded(pair.source) || isExcluded(pair.target);
                                  }),
                   eligible.end());
    if (eligible.empty()) {
      throw pcrb::InvalidProblem(matrix_path_ + ": found no pair with an overlap of at least " +
                                 pcrb::formatShortest(pcrb::minimalOverlap(kind)) +
                                 " and below 1, which " + toString(kind) + " problems need");
    }
    pcrb::Random random(
        pcrb::streamSeed(options_.seed, sequence() + " " + toString(kind) + " pairs"));
    return samplePairs(eligible, pcrb::kPairsPerList, random, options_.top_up);
  }

  std::size_t mapPosition() const {
    const auto found = std::find(matrix_.names.begin(), matrix_.names.end(), options_.map);
    if (found == matrix_.names.end()) {
      throw pcrb::InvalidParameter(matrix_path_ + ": found no cloud '" + options_.map +
                                   "', expected the overlaps with the map");
    }
    return static_cast<std::size_t>(found - matrix_.names.begin());
  }

  std::vector<pcrb::CloudPair> pairsWithMap() const {
    const std::size_t map = mapPosition();
    std::vector<pcrb::CloudPair> pairs;
    for (std::size_t source = 0; source < matrix_.names.size(); ++source) {
      if (source == map || isExcluded(matrix_.names[source])) continue;
      const double overlap = matrix_.at(source, map);
      if (std::isnan(overlap)) {
        throw pcrb::InvalidProblem(
            matrix_path_ + ": found no overlap of " + matrix_.names[source] + " with " +
            options_.map + ", expected one (compute_overlap --target " + options_.map + ")");
      }
      pairs.push_back({matrix_.names[source], matrix_.names[map], overlap});
    }
    return pairs;
  }

  void report(const std::string& output, const pcrb::ProblemList& list) const {
    std::set<std::string> different;
    double lowest = 1.0;
    double highest = 0.0;
    for (const pcrb::CloudPair& pair : list.pairs) {
      different.insert(pair.source + " " + pair.target);
      lowest = std::min(lowest, pair.overlap);
      highest = std::max(highest, pair.overlap);
    }
    std::cerr << output << ": " << list.pairs.size() * perturbationsPerPair(list.kind)
              << " problems from " << list.pairs.size() << " pairs, " << different.size()
              << " of them different, overlap " << pcrb::formatFixed(lowest, 4) << " to "
              << pcrb::formatFixed(highest, 4) << ", seed " << options_.seed << std::endl;
  }

  const SamplingOptions& options_;
  SequenceFolder folder_;
  pcrb::Dataset dataset_;
  std::string matrix_path_;
  pcrb::OverlapMatrix matrix_;
  Centroids centroids_;
};

}  // namespace

void runSamplingTool(const SamplingOptions& options) { Sampling(options).run(); }

}  // namespace pcrb_tools
