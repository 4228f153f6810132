#include "bridge/body_frame.hpp"

#include <cmath>

namespace pcrb {

Transform uprightFromOptical(const std::optional<Transform>& T_map_optical) {
  Eigen::Matrix3d body_optical;
  body_optical << 0, 0, 1,  //
      -1, 0, 0,             //
      0, -1, 0;
  double roll = 0.0;
  if (T_map_optical) {
    const Eigen::Matrix3d map_body = T_map_optical->linear() * body_optical.transpose();
    roll = std::atan2(map_body(2, 1), map_body(2, 2));
  }
  Transform T_upright_optical = Transform::Identity();
  T_upright_optical.linear() =
      Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()).toRotationMatrix() * body_optical;
  return T_upright_optical;
}

}  // namespace pcrb
