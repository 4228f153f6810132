#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "pcrb_core/point_cloud.hpp"

namespace pcrb {

/// Overlap of a source with a target: the fraction of its points that have a target point strictly
/// closer than a distance, both clouds in ground-truth pose. Not symmetric.
///
/// Exact: squared distances are (dx² + dy²) + dz² in double.
/// @param distance  m, > 0.
/// @return          in [0, 1].
/// @throws InvalidProblem  if the source is empty or a coordinate is beyond the reach of CellGrid.
/// Source: Fontana et al. 2021, section 3.2.
double computeOverlap(const DatasetCloud& source, const DatasetCloud& target, double distance);

/// The overlaps of a sequence, target by target.
struct OverlapJob {
  std::vector<std::string> files;    ///< paths of the clouds in the sequence's order
  double distance = 0.0;             ///< m, > 0
  std::size_t window = 0;            ///< pairs at most so many places apart; 0 = all pairs
  std::vector<std::size_t> targets;  ///< positions in `files` whose columns are wanted, ascending
  int threads = 1;
};

/// What happens during computeOverlaps; calls are not concurrent.
struct OverlapEvents {
  std::function<void(std::size_t cloud)> cloud_read;
  /// A target's overlaps: one value per source, 1 for itself, NaN outside the window.
  std::function<void(std::size_t target, const std::vector<double>& column)> column_done;
};

/// Number of ordered pairs of different clouds that a job computes.
std::size_t countPairs(const OverlapJob& job);

/// Computes the overlaps of all sources with the wanted targets.
///
/// Each cloud is read once. Memory: about 35 bytes per point of the clouds that are held (scans of
/// surfaces; up to 100 where points fill a volume), which are all clouds without a window, and
/// 2 · window + 4 · threads clouds with one; one cloud in the form of readPcd per thread; one
/// target's Coverage per thread. The values do not depend on the threads.
/// @throws InvalidFile       if a cloud cannot be read.
/// @throws InvalidProblem    if a cloud is empty, or is not in the frame of the others.
/// @throws InvalidParameter  if the distance is not positive, or a target is no position in
/// `files`.
void computeOverlaps(const OverlapJob& job, const OverlapEvents& events);

}  // namespace pcrb
