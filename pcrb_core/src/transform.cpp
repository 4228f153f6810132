#include "pcrb_core/transform.hpp"

#include <cmath>
#include <string>

#include "arithmetic.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb {

Transform requireRigid(const Eigen::Matrix<double, 3, 4>& rows) {
  if (!rows.allFinite()) throw InvalidProblem("transform has an entry that is not finite");
  const Eigen::Matrix3d R = rows.leftCols<3>();
  const double deviation = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  if (!(deviation <= kRigidTolerance) || R.determinant() < 0.0) {
    throw InvalidProblem("transform is not rigid: found |R'R - I| = " + std::to_string(deviation) +
                         " and det R = " + std::to_string(R.determinant()) +
                         ", expected at most 1e-6 and 1");
  }
  Transform T = Transform::Identity();
  T.linear() = R;
  T.translation() = rows.col(3);
  return T;
}

Transform makeTransform(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation) {
  const double norm = rotation.norm();
  if (!translation.allFinite() || !std::isfinite(norm)) {
    throw InvalidProblem("pose has an entry that is not finite");
  }
  if (norm < 1e-9) throw InvalidProblem("pose has a quaternion of norm 0, expected 1");
  Transform T = Transform::Identity();
  T.linear() = rotation.normalized().toRotationMatrix();
  T.translation() = translation;
  return T;
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

Transform inLocalFrame(const Transform& T, const Eigen::Vector3d& local_origin) {
  Transform local = T;
  for (int row = 0; row < 3; ++row) {
    DoubleDouble moved;  // row of T · o − o
    moved.add(T.translation()[row]);
    for (int i = 0; i < 3; ++i) moved.addProduct(T.linear()(row, i), local_origin[i]);
    moved.add(-local_origin[row]);
    local.translation()[row] = moved.value();
  }
  return local;
}

double rotationAngle(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d axis_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(axis_sine.norm(), R.trace() - 1.0);
}

}  // namespace pcrb
