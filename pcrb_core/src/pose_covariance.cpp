#include "pcrb_core/pose_covariance.hpp"

namespace pcrb {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

PoseCovariance propagated(const PoseCovariance& covariance, const Matrix6& J) {
  PoseCovariance result{};
  Eigen::Map<Matrix6>(result.data()) =
      J * Eigen::Map<const Matrix6>(covariance.data()) * J.transpose();
  return result;
}

}  // namespace

PoseCovariance rotatedCovariance(const PoseCovariance& in_parent,
                                 const Eigen::Matrix3d& R_map_parent) {
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = R_map_parent;
  J.bottomRightCorner<3, 3>() = R_map_parent;
  return propagated(in_parent, J);
}

PoseCovariance planarCovariance(double position, double angle) {
  PoseCovariance covariance{};
  covariance[0] = covariance[7] = position * position;
  covariance[35] = angle * angle;
  return covariance;
}

PoseCovariance mountedCovariance(const PoseCovariance& of_a, const Transform& T_map_a,
                                 const Transform& T_a_b) {
  // d p_b = d p_a + d theta × arm
  const Eigen::Vector3d arm = T_map_a.linear() * T_a_b.translation();
  Matrix6 J = Matrix6::Identity();
  J.topRightCorner<3, 3>() = -crossMatrix(arm);
  return propagated(of_a, J);
}

}  // namespace pcrb
