#pragma once

#include <Eigen/Core>
#include <vector>

#include "pcrb_core/registration/preprocessing.hpp"

namespace pcrb {

// The robust estimators of TEASER: least squares whose residuals count up to a bound only. Source:
// Yang, Shi, Carlone, TEASER: Fast and certifiable point cloud registration, T-RO 2021.

struct RobustRotation {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  int iterations = 0;
};

/// Rotation R with the least Σ min(‖b − R a‖², bound²) by graduated non-convexity. Vectors are the
/// differences of all pairs of points: a of `source`, b of `target`.
///
/// @param bound  m, of the error of a difference.
/// Source: Yang, Antonante, Tzoumas, Carlone, Graduated non-convexity for robust spatial
/// perception, RA-L 2020 (GNC-TLS).
RobustRotation estimateRotation(const Points& source, const Points& target, double bound,
                                int max_iterations, int threads);

/// The number t with the least Σ min((x − t)², bound²), by adaptive voting: exact.
double estimateNumber(const std::vector<double>& values, double bound);

}  // namespace pcrb
