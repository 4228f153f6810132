#pragma once

#include <array>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// Row-major x y z rx ry rz, about the axes of the frame that the pose is in.
using PoseCovariance = std::array<double, 36>;

/// Of a pose that is known but for x, y and yaw, which have these standard deviations (m, rad); as
/// rviz sends it.
PoseCovariance planarCovariance(double position, double angle);

/// The same covariance about the axes of another frame.
PoseCovariance rotatedCovariance(const PoseCovariance& in_parent,
                                 const Eigen::Matrix3d& R_map_parent);

/// The covariance of the pose of a frame `b` that is mounted on `a`, of that of `a`: a rotation
/// moves what is mounted away from its origin. First order.
PoseCovariance mountedCovariance(const PoseCovariance& of_a, const Transform& T_map_a,
                                 const Transform& T_a_b);

}  // namespace pcrb
