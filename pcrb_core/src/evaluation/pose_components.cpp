#include "pcrb_core/evaluation/pose_components.hpp"

#include <cmath>

namespace pcrb {

PoseComponents poseComponents(const Transform& T_residual, const Eigen::Vector3d& centroid) {
  const Eigen::Matrix3d R = T_residual.linear();
  PoseComponents components;
  components.translation = T_residual * centroid - centroid;
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  components.pitch = std::atan2(-R(2, 0), cos_pitch);
  constexpr double kVertical = 1e-12;  // cos of a pitch at which roll and yaw turn about one axis
  if (cos_pitch < kVertical) {
    components.yaw = std::atan2(-R(0, 1), R(1, 1));
  } else {
    components.roll = std::atan2(R(2, 1), R(2, 2));
    components.yaw = std::atan2(R(1, 0), R(0, 0));
  }
  return components;
}

}  // namespace pcrb
