#include "pcrb_core/problem/dataset_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <set>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/parallel.hpp"
#include "pcrb_core/problem/overlap.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb {
namespace {

/// Of the bits of the coordinates.
std::size_t hashOf(const std::vector<Eigen::Vector3d>& points) {
  Fnv1a hash;
  for (const Eigen::Vector3d& point : points) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      std::uint64_t bits = 0;
      const double coordinate = point[axis];
      std::memcpy(&bits, &coordinate, sizeof(bits));
      hash.add(bits);
    }
  }
  return hash.value();
}

/// Findings about one cloud; its summary if it could be read.
std::optional<CloudSummary> checkCloud(const std::string& path, std::vector<Finding>& findings) {
  try {
    const DatasetCloud cloud = readPcd(path);
    for (const std::string& note : cloud.notes) findings.push_back({Severity::kNote, path, note});
    if (cloud.dropped_non_finite > 0) {
      findings.push_back({Severity::kNote, path,
                          std::to_string(cloud.dropped_non_finite) +
                              " points with a coordinate that is not finite are left out"});
    }
    if (!cloud.points.empty()) return summarize(cloud);
    findings.push_back({Severity::kError, path, "cloud has no points"});
  } catch (const InvalidFile& error) {
    // The message begins with the path, perhaps with a line.
    findings.push_back({Severity::kError, "", error.what()});
  }
  return std::nullopt;
}

void findDuplicates(const std::string& folder, const CloudSummaries& summaries,
                    std::vector<Finding>& findings) {
  std::map<std::pair<std::size_t, std::size_t>, std::string> first;
  for (const auto& [name, summary] : summaries) {
    if (!summary) continue;
    const auto [earlier, is_new] = first.emplace(std::pair(summary->hash, summary->points), name);
    if (is_new) continue;
    findings.push_back(
        {Severity::kWarning, folder + "/" + name, "has the same points as " + earlier->second});
  }
}

}  // namespace

const char* toString(Severity severity) {
  switch (severity) {
    case Severity::kNote:
      return "note";
    case Severity::kWarning:
      return "warning";
    case Severity::kError:
      break;
  }
  return "error";
}

CloudSummary summarize(const DatasetCloud& cloud) {
  CloudSummary summary;
  summary.points = cloud.points.size();
  summary.dropped_non_finite = cloud.dropped_non_finite;
  summary.has_viewpoint = cloud.hasViewpoint();
  summary.centroid = centroid(cloud);
  for (const Eigen::Vector3d& point : cloud.points) summary.box.extend(point);
  summary.hash = hashOf(cloud.points);
  return summary;
}

std::vector<Finding> checkClouds(const std::string& folder, int threads, CloudSummaries& summaries,
                                 const std::function<void()>& on_cloud) {
  const std::vector<std::string> names = findClouds(folder);
  std::vector<std::vector<Finding>> of_cloud(names.size());
  std::mutex mutex;
  summaries.clear();
  parallelFor(names.size(), threads, [&](std::size_t i) {
    const auto summary = checkCloud(folder + "/" + names[i], of_cloud[i]);
    const std::lock_guard<std::mutex> lock(mutex);
    summaries[names[i]] = summary;
    if (on_cloud) on_cloud();
  });
  std::vector<Finding> findings;
  if (names.empty()) findings.push_back({Severity::kError, folder, "has no .pcd file"});
  for (const auto& some : of_cloud) findings.insert(findings.end(), some.begin(), some.end());
  findDuplicates(folder, summaries, findings);
  std::size_t without_viewpoint = 0;
  for (const auto& [name, summary] : summaries) {
    without_viewpoint += summary && !summary->has_viewpoint ? 1 : 0;
  }
  if (without_viewpoint > 0) {
    findings.push_back({Severity::kNote, folder,
                        std::to_string(without_viewpoint) + " of " + std::to_string(names.size()) +
                            " clouds have no VIEWPOINT: their sensor's pose is unknown"});
  }
  return findings;
}

namespace {

/// Published overlaps have four decimals and were computed by an approximate search
/// (docs/methods.md).
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
