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
