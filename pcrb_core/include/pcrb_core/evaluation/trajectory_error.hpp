#pragma once

#include <cstddef>
#include <vector>

#include "pcrb_core/transform.hpp"

namespace pcrb {

// Errors of a trajectory as the field defines them, and the tool evo computes them: absolute pose
// errors (APE, also ATE) and relative pose errors (RPE) of poses that belong to each other one by
// one. Sources: Sturm et al., IROS 2012 (RPE); Kuemmerle et al., Autonomous Robots 2009 (APE);
// Umeyama, PAMI 1991 (alignment).

using Poses = std::vector<Transform>;

/// Errors of all poses, or pairs of poses, in their order.
struct PoseErrors {
  std::vector<double> translation;  ///< m
  std::vector<double> rotation;     ///< rad, in [0, pi]
};

/// Of reference and estimate at the same time: distance of the positions, and angle between the
/// orientations.
///
/// @throws InvalidParameter  if the two have not the same number of poses, or none.
PoseErrors absolutePoseErrors(const Poses& reference, const Poses& estimate);

/// Of the motions between poses `delta` places apart, pairs one behind the other (0 and delta,
/// delta and 2 delta …): translation and angle of (Q_i^-1 Q_j)^-1 (P_i^-1 P_j) with reference Q and
/// estimate P. None if there are not more than `delta` poses.
///
/// @throws InvalidParameter  as absolutePoseErrors(), and if delta is 0.
PoseErrors relativePoseErrors(const Poses& reference, const Poses& estimate, std::size_t delta);

/// The same of the motions over at least `metres` of the reference's path, one behind the other.
///
/// @throws InvalidParameter  as absolutePoseErrors(), and unless metres > 0.
PoseErrors relativePoseErrorsOver(const Poses& reference, const Poses& estimate, double metres);

/// Drift as KITTI's odometry benchmark measures it: of each motion from every `step`-th pose over
/// more than each of some lengths of the reference's path, the error by that length; their mean.
struct Drift {
  std::size_t segments = 0;                 ///< 0: no path is that long, the others are NaN
  std::vector<double> lengths;              ///< m, of the path, those that have segments
  double translation_percent = 0.0;         ///< t_rel, of the length
  double rotation_degrees_per_metre = 0.0;  ///< r_rel
};

/// @param lengths  m, each > 0; empty = KITTI's 100, 200 … 800 m, divided by 10 until the path is
///                 longer than one of them. Those that are longer have no segments, as in KITTI's.
/// @param step     0 = KITTI's 10, or 1 for fewer than 100 poses.
/// @throws InvalidParameter  as absolutePoseErrors(), and for a length that is not > 0.
/// Source: Geiger, Lenz, Urtasun, CVPR 2012, and the devkit of the odometry benchmark.
Drift drift(const Poses& reference, const Poses& estimate, std::vector<double> lengths = {},
            std::size_t step = 0);

/// The estimate moved as a whole, rigidly, such that the sum of its squared position errors is
/// least.
///
/// @throws InvalidParameter  as absolutePoseErrors(); if there are fewer than three poses, or the
///                           positions do not determine the motion (all on a line).
Poses alignToReference(const Poses& reference, const Poses& estimate);

/// The statistics that evo prints; NaN where there is no value.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double stddev = 0.0;  ///< with n in the denominator
  double min = 0.0;
  double max = 0.0;
  double sse = 0.0;  ///< sum of squares
};

/// @throws InvalidParameter  if a value is not finite.
ErrorStatistics describeErrors(const std::vector<double>& errors);

}  // namespace pcrb
