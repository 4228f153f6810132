#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/dataset_check.hpp"
#include "pcrb_core/problem/overlap.hpp"
#include "pcrb_core/problem/problem_file.hpp"

namespace pcrb {
namespace {

/// Published overlaps have four decimals and were computed by an approximate search (DESIGN §3).
constexpr double kOverlapTolerance = 2e-3;

/// More than an approximate search misses, or than another conversion of the same scans changes:
/// the overlaps belong to other clouds, another distance, or source and target are exchanged.
constexpr double kOverlapLimit = 0.05;

/// The first problem of each different pair whose clouds are both readable.
std::vector<Problem> firstOfPairs(const std::vector<Problem>& problems,
                                  const CloudSummaries& summaries) {
  const auto is_readable = [&](const std::string& name) {
    const auto found = summaries.find(name);
    return found != summaries.end() && found->second;
  };
  std::set<std::pair<std::string, std::string>> seen;
  std::vector<Problem> first;
  for (const Problem& problem : problems) {
    if (!is_readable(problem.source) || !is_readable(problem.target)) continue;
    if (seen.emplace(problem.source, problem.target).second) first.push_back(problem);
  }
  return first;
}

}  // namespace

std::vector<Finding> checkOverlaps(const SequenceFiles& files, const Dataset& dataset,
                                   const CloudSummaries& summaries, std::size_t count) {
  const std::vector<Problem> pairs = firstOfPairs(readProblemFile(files.problem_file), summaries);
  const std::size_t checked = std::min(count, pairs.size());
  std::size_t wrong = 0;
  double worst = 0.0;
  double computed = 0.0;
  const Problem* example = nullptr;
  for (std::size_t i = 0; i < checked; ++i) {
    const Problem& pair = pairs[i * pairs.size() / checked];
    const double overlap =
        computeOverlap(readPcd(files.cloud_folder + "/" + pair.source),
                       readPcd(files.cloud_folder + "/" + pair.target), dataset.overlap_distance);
    const double difference = std::abs(overlap - pair.overlap);
    if (difference <= kOverlapTolerance) continue;
    ++wrong;
    if (difference <= worst) continue;
    worst = difference;
    computed = overlap;
    example = &pair;
  }
  if (wrong == 0) return {};
  return {{worst > kOverlapLimit ? Severity::kError : Severity::kWarning, files.problem_file,
           "the overlap of " + std::to_string(wrong) + " of " + std::to_string(checked) +
               " recomputed pairs differs by up to " + formatFixed(worst, 4) + " (" +
               example->source + " on " + example->target + ": found " +
               formatFixed(example->overlap, 4) + ", expected " + formatFixed(computed, 4) +
               " of these clouds; distance " + formatShortest(dataset.overlap_distance) + " m)"}};
}

}  // namespace pcrb
