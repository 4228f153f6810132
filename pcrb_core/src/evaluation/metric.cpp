#include "pcrb_core/evaluation/metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "arithmetic.hpp"
#include "evaluation/metric_kernel.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

/// Distance from the centroid, m, up to which a point carries no weight.
constexpr double kWeightlessRadius = 1e-9;

std::size_t padded(std::size_t size) { return (size + kLanes - 1) / kLanes * kLanes; }

/// A number as value · 2^exponent, so that squares of absurd residuals stay finite.
struct Scaled {
  Displacement displacement;
  int exponent = 0;
};

/// What T_residual does to points, seen from the centroid.
Scaled displacementAbout(const Eigen::Vector3d& centroid, const Transform& T_residual) {
  const Transform T = inLocalFrame(requireRigid(T_residual.matrix().topRows<3>()), centroid);
  constexpr int kExponentLimit = 300;  // coordinates up to 2^128 and squares still fit
  Scaled scaled;
  std::frexp(T.translation().lpNorm<Eigen::Infinity>(), &scaled.exponent);
  if (scaled.exponent <= kExponentLimit) scaled.exponent = 0;
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 3; ++i) {
      const double entry = T.linear()(row, i) - (row == i ? 1.0 : 0.0);
      scaled.displacement.linear[row][i] = std::ldexp(entry, -scaled.exponent);
    }
    scaled.displacement.center[row] = centroid[row];
    scaled.displacement.offset[row] = std::ldexp(T.translation()[row], -scaled.exponent);
  }
  return scaled;
}

/// value · 2^exponent, at most the largest double.
double unscaled(double value, int exponent) {
  return std::min(std::ldexp(value, exponent), std::numeric_limits<double>::max());
}

/// The centroid in twice the precision of double: points close to it have large weights.
struct Centroid {
  explicit Centroid(const std::vector<Eigen::Vector3f>& points) {
    std::array<DoubleDouble, 3> sums;
    for (const Eigen::Vector3f& point : points) {
      sums[0].add(point.x());
      sums[1].add(point.y());
      sums[2].add(point.z());
    }
    const double count = static_cast<double>(points.size());
    for (int i = 0; i < 3; ++i) {
      DoubleDouble& sum = sums[static_cast<std::size_t>(i)];
      high[i] = sum.value() / count;
      sum.addProduct(-count, high[i]);
      low[i] = sum.value() / count;
    }
  }

  double distance(const Eigen::Vector3f& point) const {
    return (point.cast<double>() - high - low).norm();
  }

  Eigen::Vector3d high;
  Eigen::Vector3d low;
};

}  // namespace

Metric::Metric(const PointCloud& source) : size_(source.size()) {
  if (source.points.empty()) throw InvalidProblem("source cloud has no points");
  const Centroid centroid(source.points);
  if (!centroid.high.allFinite())
    throw InvalidProblem("source cloud has a point that is not finite");
  centroid_ = centroid.high;
  for (std::vector<float>& axis : axes_) axis.resize(padded(size_));
  weights_.resize(padded(size_));
  for (std::size_t i = 0; i < size_; ++i) {
    const Eigen::Vector3f& point = source.points[i];
    axes_[0][i] = point.x();
    axes_[1][i] = point.y();
    axes_[2][i] = point.z();
    const double distance = centroid.distance(point);
    if (distance <= kWeightlessRadius) continue;
    weights_[i] = 1.0 / distance;
    ++weighted_;
  }
  if (weighted_ == 0) {
    throw InvalidProblem("source cloud has " + std::to_string(size_) +
                         " points, all at their centroid; expected one at some distance from it");
  }
}

PoseError Metric::evaluate(const Transform& T_residual) const {
  const auto [displacement, exponent] = displacementAbout(centroid_, T_residual);
  const PointArrays points{axes_[0].data(), axes_[1].data(), axes_[2].data(), weights_.size()};
  const double sum = sumOfNorms(points, weights_.data(), displacement);
  const Eigen::Vector3d offset = Eigen::Vector3d::Map(displacement.offset);
  return {unscaled(sum / static_cast<double>(weighted_), exponent),
          rotationAngle(T_residual.linear()), unscaled(offset.norm(), exponent)};
}

double Metric::unnormalized(const Transform& T_residual) const {
  const auto [displacement, exponent] = displacementAbout(centroid_, T_residual);
  constexpr std::size_t kBlock = 512 * kLanes;
  std::vector<double> weights(kBlock, 1.0);
  double sum = 0.0;
  for (std::size_t first = 0; first < size_; first += kBlock) {
    const std::size_t count = std::min(kBlock, size_ - first);
    std::fill(weights.begin() + static_cast<std::ptrdiff_t>(count), weights.end(), 0.0);
    const PointArrays points{&axes_[0][first], &axes_[1][first], &axes_[2][first], padded(count)};
    sum += sumOfNorms(points, weights.data(), displacement);
  }
  return unscaled(sum / static_cast<double>(size_), exponent);
}

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
