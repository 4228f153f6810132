#include "bridge/body_frame.hpp"

#include <cmath>

namespace pcrb {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

}  // namespace

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

std::array<double, 36> sensorCovariance(const std::array<double, 36>& body,
                                        const Transform& T_map_body,
                                        const Transform& T_body_sensor) {
  // d p_sensor = d p_body + d theta × arm
  const Eigen::Vector3d arm = T_map_body.linear() * T_body_sensor.translation();
  Matrix6 J = Matrix6::Identity();
  J.topRightCorner<3, 3>() = -crossMatrix(arm);
  std::array<double, 36> sensor{};
  Eigen::Map<Matrix6>(sensor.data()) = J * Eigen::Map<const Matrix6>(body.data()) * J.transpose();
  return sensor;
}

}  // namespace pcrb
