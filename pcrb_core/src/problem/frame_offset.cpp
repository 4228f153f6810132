#include "pcrb_core/problem/frame_offset.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

/// Smallest eigenvalue of Σ (R − I)ᵀ(R − I), relative to the largest, that determines an offset.
constexpr double kMinimalCondition = 1e-9;

Eigen::Vector3d motion(const PerturbedCentroid& row, const Eigen::Vector3d& offset) {
  return (row.P.linear() - Eigen::Matrix3d::Identity()) * (row.centroid + offset) +
         row.P.translation();
}

}  // namespace

FrameOffset estimateFrameOffset(const std::vector<PerturbedCentroid>& rows) {
  // Normal equations of (R − I) o = −motion without offset.
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const PerturbedCentroid& row : rows) {
    const Eigen::Matrix3d D = row.P.linear() - Eigen::Matrix3d::Identity();
    A += D.transpose() * D;
    b -= D.transpose() * motion(row, Eigen::Vector3d::Zero());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(A);
  const bool is_determined =
      rows.size() >= 2 &&
      eigen.eigenvalues().minCoeff() > kMinimalCondition * eigen.eigenvalues().maxCoeff();
  if (!is_determined) {
    throw InvalidProblem(
        "found " + std::to_string(rows.size()) +
        " perturbations whose rotations do not determine an offset between frames");
  }
  const Eigen::Matrix3d inverse = A.inverse();
  FrameOffset estimate;
  estimate.offset = inverse * b;
  double squares = 0.0;
  for (const PerturbedCentroid& row : rows) squares += motion(row, estimate.offset).squaredNorm();
  const double n = static_cast<double>(rows.size());
  estimate.residual = std::sqrt(squares / n);
  const double variance = squares / (3.0 * n - 3.0);
  estimate.standard_error = (variance * inverse.diagonal()).cwiseSqrt();
  return estimate;
}

}  // namespace pcrb
