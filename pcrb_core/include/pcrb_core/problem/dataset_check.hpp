#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/problem/dataset.hpp"

namespace pcrb {

enum class Severity { kNote, kWarning, kError };

/// `note`, `warning` or `error`.
const char* toString(Severity severity);

/// One thing that a check found: an error is what a benchmark run would stumble over, a warning
/// what its results might suffer from, a note what a reader of the results might want to know.
struct Finding {
  Severity severity = Severity::kError;
  std::string file;  ///< path, perhaps with a line
  std::string what;
};

/// What checks need to know of a cloud after its points are forgotten.
struct CloudSummary {
  std::size_t points = 0;
  std::size_t dropped_non_finite = 0;
  bool has_viewpoint = false;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< m
  Eigen::AlignedBox3d box;                             ///< m
  std::size_t hash = 0;                                ///< of the coordinates
};

/// The clouds of a folder by file name; those that cannot be read have no summary.
using CloudSummaries = std::map<std::string, std::optional<CloudSummary>>;

/// @throws InvalidProblem  if the cloud has no points.
CloudSummary summarize(const DatasetCloud& cloud);

/// Checks the clouds of a folder: readable, not empty, none twice under two names, no points lost.
///
/// @param summaries  set to what was found.
/// @param on_cloud   called after each cloud, from any thread.
/// @throws InvalidFile  if the folder cannot be listed.
std::vector<Finding> checkClouds(const std::string& folder, int threads, CloudSummaries& summaries,
                                 const std::function<void()>& on_cloud = {});

/// Checks a problem file against its folder's clouds: rows, clouds present, perturbations rigid and
/// in the clouds' frame (else the offset that would explain all rows), spans that can be served,
/// repeated rows and pairs, ids, overlaps in the range of their kind.
std::vector<Finding> checkProblems(const SequenceFiles& files, const Dataset& dataset,
                                   const CloudSummaries& summaries);

/// Recomputes the overlap of a sample of pairs, the same for the same file: a difference as of the
/// published, approximate overlaps is a warning, a larger one (0.05) an error.
///
/// @param count  number of different pairs, evenly spread over the file.
/// @throws InvalidFile  if the problem file is malformed, which checkProblems reports.
std::vector<Finding> checkOverlaps(const SequenceFiles& files, const Dataset& dataset,
                                   const CloudSummaries& summaries, std::size_t count);

}  // namespace pcrb
