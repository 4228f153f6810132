#include "pcrb_core/evaluation/trajectory_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/statistics.hpp"

namespace pcrb {
namespace {

void requireMatching(const Poses& reference, const Poses& estimate) {
  if (reference.size() == estimate.size() && !reference.empty()) return;
  throw InvalidParameter("trajectories: found " + std::to_string(reference.size()) +
                         " poses of the reference and " + std::to_string(estimate.size()) +
                         " of the estimate, expected the same number of both, at least one");
}

/// The positions as columns, relative to their mean, which is set.
Eigen::Matrix3Xd centredPositions(const Poses& poses, Eigen::Vector3d& mean) {
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    positions.col(static_cast<Eigen::Index>(i)) = poses[i].translation();
  }
  mean = positions.rowwise().mean();
  positions.colwise() -= mean;
  return positions;
}

/// Whether two singular values of a covariance are clear of rounding: else any turn about the line
/// that the positions lie on fits.
bool determinesRotation(const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d values = Eigen::JacobiSVD<Eigen::Matrix3d>(covariance).singularValues();
  return values[1] > 1e-12 * values[0];
}

}  // namespace

PoseErrors absolutePoseErrors(const Poses& reference, const Poses& estimate) {
  requireMatching(reference, estimate);
  PoseErrors errors;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    errors.translation.push_back((estimate[i].translation() - reference[i].translation()).norm());
    errors.rotation.push_back(
        rotationAngle(estimate[i].linear().transpose() * reference[i].linear()));
  }
  return errors;
}

PoseErrors relativePoseErrors(const Poses& reference, const Poses& estimate, std::size_t delta) {
  requireMatching(reference, estimate);
  if (delta == 0) throw InvalidParameter("relative pose error: found a delta of 0, expected more");
  PoseErrors errors;
  for (std::size_t i = 0; i + delta < reference.size(); i += delta) {
    const Transform Q = reference[i].inverse() * reference[i + delta];
    const Transform P = estimate[i].inverse() * estimate[i + delta];
    const Transform E = Q.inverse() * P;
    errors.translation.push_back(E.translation().norm());
    errors.rotation.push_back(rotationAngle(E.linear()));
  }
  return errors;
}

Poses alignToReference(const Poses& reference, const Poses& estimate) {
  requireMatching(reference, estimate);
  Eigen::Vector3d reference_mean;
  Eigen::Vector3d estimate_mean;
  const Eigen::Matrix3Xd y = centredPositions(reference, reference_mean);
  const Eigen::Matrix3Xd x = centredPositions(estimate, estimate_mean);
  const Eigen::Matrix3d covariance = y * x.transpose();
  if (reference.size() < 3 || !determinesRotation(covariance)) {
    throw InvalidParameter(
        "alignment: found positions on a line, or fewer than three, expected some that determine "
        "a rotation");
  }
  Transform T = Transform::Identity();  // T_reference_estimate
  T.linear() = nearestRotation(covariance);
  T.translation() = reference_mean - T.linear() * estimate_mean;
  Poses aligned;
  for (const Transform& pose : estimate) aligned.push_back(T * pose);
  return aligned;
}

ErrorStatistics describeErrors(const std::vector<double>& errors) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const Statistics common = describe(errors);
  if (errors.empty()) return {0, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
  ErrorStatistics statistics;
  statistics.count = common.count;
  statistics.mean = common.mean;
  statistics.median = common.median;
  statistics.stddev = common.stddev;
  const auto [min, max] = std::minmax_element(errors.begin(), errors.end());
  statistics.min = *min;
  statistics.max = *max;
  for (const double error : errors) statistics.sse += error * error;
  statistics.rmse = std::sqrt(statistics.sse / static_cast<double>(errors.size()));
  return statistics;
}

}  // namespace pcrb
