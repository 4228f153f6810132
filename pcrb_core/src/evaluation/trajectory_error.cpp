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

void requireLength(double metres) {
  if (metres > 0.0 && std::isfinite(metres)) return;
  throw InvalidParameter("trajectories: found a length of " + std::to_string(metres) +
                         " m, expected one greater than 0");
}

/// m, of the way to each pose from the first.
std::vector<double> pathLengths(const Poses& poses) {
  std::vector<double> path{0.0};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    path.push_back(path.back() + (poses[i].translation() - poses[i - 1].translation()).norm());
  }
  return path;
}

std::vector<double> kittiLengths(double path) {
  constexpr int kLengths = 8;
  double unit = 100.0;
  while (unit >= path && unit > 1e-3) unit /= 10.0;
  std::vector<double> lengths;
  for (int i = 1; i <= kLengths; ++i) lengths.push_back(unit * i);
  return lengths;
}

/// Of the motion between two poses: (Q_i^-1 Q_j)^-1 (P_i^-1 P_j).
void addMotionError(const Poses& reference, const Poses& estimate, std::size_t i, std::size_t j,
                    PoseErrors& errors) {
  const Transform Q = reference[i].inverse() * reference[j];
  const Transform P = estimate[i].inverse() * estimate[j];
  const Transform E = Q.inverse() * P;
  errors.translation.push_back(E.translation().norm());
  errors.rotation.push_back(rotationAngle(E.linear()));
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
    addMotionError(reference, estimate, i, i + delta, errors);
  }
  return errors;
}

PoseErrors relativePoseErrorsOver(const Poses& reference, const Poses& estimate, double metres) {
  requireMatching(reference, estimate);
  requireLength(metres);
  const std::vector<double> path = pathLengths(reference);
  PoseErrors errors;
  std::size_t first = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] - path[first] < metres) continue;
    addMotionError(reference, estimate, first, i, errors);
    first = i;
  }
  return errors;
}

Drift drift(const Poses& reference, const Poses& estimate, std::vector<double> lengths,
            std::size_t step) {
  requireMatching(reference, estimate);
  const std::vector<double> path = pathLengths(reference);
  if (lengths.empty()) lengths = kittiLengths(path.back());
  for (const double length : lengths) requireLength(length);
  constexpr std::size_t kKittiStep = 10;
  if (step == 0) step = reference.size() < 10 * kKittiStep ? 1 : kKittiStep;
  Drift result;
  double translation = 0.0;
  double rotation = 0.0;
  for (const double length : lengths) {
    const std::size_t known = result.segments;
    for (std::size_t first = 0; first < path.size(); first += step) {
      const auto last = std::upper_bound(path.begin(), path.end(), path[first] + length);
      if (last == path.end()) continue;
      PoseErrors error;
      addMotionError(reference, estimate, first, static_cast<std::size_t>(last - path.begin()),
                     error);
      translation += error.translation.back() / length;
      rotation += error.rotation.back() / length;
      ++result.segments;
    }
    if (result.segments > known) result.lengths.push_back(length);
  }
  const double n = static_cast<double>(result.segments);  // 0 / 0 is NaN
  result.translation_percent = 100.0 * translation / n;
  result.rotation_degrees_per_metre = rotation / n * 180.0 / M_PI;
  return result;
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
