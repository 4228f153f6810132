#pragma once

#include <Eigen/Core>
#include <array>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// What is wrong with a pose along and about each axis of the data set's frame.
struct PoseComponents {
  Eigen::Vector3d translation;  ///< m, of the source's centroid
  double roll = 0.0;            ///< rad, in (−π, π]
  double pitch = 0.0;           ///< rad, in [−π/2, π/2]
  double yaw = 0.0;             ///< rad, in (−π, π]

  /// x, y, z, roll, pitch, yaw.
  std::array<double, 6> values() const {
    return {translation.x(), translation.y(), translation.z(), roll, pitch, yaw};
  }
};

/// Components of T_residual, R = Rz(yaw) · Ry(pitch) · Rx(roll); at pitch ±π/2 roll is 0.
///
/// @param centroid  of the source at ground truth, m, in T_residual's frame.
PoseComponents poseComponents(const Transform& T_residual, const Eigen::Vector3d& centroid);

}  // namespace pcrb
