#include "problem/frame_offset.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

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

namespace {

/// Frames whose clouds are farther than this from the origin, m, are called far.
constexpr double kFar = 1000.0;

/// How far an offset may be from the clouds' mean centroid, as a part of it, to be called double.
constexpr double kDoubleTolerance = 0.01;

/// Rows of a source that its centroid is estimated from.
constexpr std::size_t kMinRows = 20;

std::string xyz(const Eigen::Vector3d& v, int decimals) {
  return "(" + formatFixed(v.x(), decimals) + ", " + formatFixed(v.y(), decimals) + ", " +
         formatFixed(v.z(), decimals) + ")";
}

bool isDouble(const std::vector<PerturbedCentroid>& rows, const Eigen::Vector3d& offset) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const PerturbedCentroid& row : rows) sum += row.centroid;
  const Eigen::Vector3d mean = sum / static_cast<double>(rows.size());
  return mean.norm() > kFar && (offset - mean).norm() < kDoubleTolerance * mean.norm();
}

std::string explainEstimate(const std::vector<PerturbedCentroid>& rows, const FrameOffset& estimate,
                            double max_motion) {
  const auto left = static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const PerturbedCentroid& row) {
        return centroidMotion(row, estimate.offset) > max_motion;
      }));
  const std::string offset =
      xyz(estimate.offset, 2) + " m, standard error " + xyz(estimate.standard_error, 2) + " m";
  if (left > 0) {
    return "no single offset explains it: the best, " + offset + ", leaves " +
           outOf(left, rows.size()) + " rows too far";
  }
  return "one offset of the clouds explains all rows: " + offset +
         (isDouble(rows, estimate.offset)
              ? "; the problem file's coordinates are about twice the clouds'"
              : "");
}

}  // namespace

std::string outOf(std::size_t some, std::size_t all) {
  return std::to_string(some) + " of " + std::to_string(all);
}

double centroidMotion(const PerturbedCentroid& row, const Eigen::Vector3d& offset) {
  const Eigen::Vector3d centroid = row.centroid + offset;
  return ((row.P.linear() - Eigen::Matrix3d::Identity()) * centroid + row.P.translation()).norm();
}

std::string explainOffset(const std::vector<PerturbedCentroid>& rows, double max_motion) {
  try {
    return explainEstimate(rows, estimateFrameOffset(rows), max_motion);
  } catch (const InvalidProblem& error) {
    return error.what();
  }
}

std::string describeCentroids(
    const std::map<std::string, std::vector<PerturbedCentroid>>& rows_of) {
  Eigen::AlignedBox3d box;
  for (const auto& [source, rows] : rows_of) {
    if (rows.size() < kMinRows) continue;
    try {
      box.extend(estimateFrameOffset(rows).offset);
    } catch (const InvalidProblem&) {
      continue;  // rotations all about one axis tell no centroid
    }
  }
  if (box.isEmpty()) return "";
  return "; its rows rotate about centroids within " + formatFixed(box.sizes().x(), 0) + " x " +
         formatFixed(box.sizes().y(), 0) + " m of " + xyz(box.center(), 0);
}

}  // namespace pcrb
