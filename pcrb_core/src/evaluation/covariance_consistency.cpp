#include "pcrb_core/evaluation/covariance_consistency.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/statistics.hpp"

namespace pcrb {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

constexpr double kQuantile50 = 0.6744897501960817;  // of the normal distribution, two-sided 50 %
constexpr double kQuantile95 = 1.9599639845400545;  // two-sided 95 %
constexpr std::size_t kFewestUnits = 6;             // fewer tell nothing

void requireUnits(std::size_t judged, std::size_t units) {
  if (judged == 0 || judged != units) {
    throw InvalidParameter("covariances: found " + std::to_string(judged) + " errors and " +
                           std::to_string(units) + " units, expected equally many, at least one");
  }
}

/// The axes that have a variance; nothing if a matrix can be no covariance.
std::optional<std::vector<int>> axesOf(const Matrix6& C) {
  if (!C.allFinite()) return std::nullopt;
  std::vector<int> axes;
  for (int i = 0; i < 6; ++i) {
    if (C(i, i) < 0.0) return std::nullopt;
    if (C(i, i) > 0.0) axes.push_back(i);
    for (int j = 0; j < 6; ++j) {
      const double scale = std::sqrt(C(i, i)) * std::sqrt(std::abs(C(j, j)));
      constexpr double kRounding = 1e-6;  // float32 in a node's filter
      if (std::abs(C(i, j) - C(j, i)) > kRounding * scale) return std::nullopt;
      if (scale == 0.0 && C(i, j) != 0.0) return std::nullopt;
    }
  }
  if (axes.empty()) return std::nullopt;
  return axes;
}

std::string verdictOf(const Calibration& calibration, std::size_t units) {
  if (units < kFewestUnits) return "too few pairs to tell";
  const bool middle_is_low = calibration.inside_50.high < 0.5;
  const bool middle_is_high = calibration.inside_50.low > 0.5;
  const bool tail_is_low = calibration.inside_95.high < 0.95;
  if (tail_is_low && middle_is_high) {
    return "underconfident where it is right, overconfident where it fails";
  }
  if (tail_is_low && !middle_is_low) return "overconfident where it fails";
  if (tail_is_low || middle_is_low) return "overconfident";
  if (middle_is_high) return "underconfident";
  return "as large as the errors";
}

/// Fraction of the errors that lie in the ellipsoid of a probability.
double inside(const std::vector<JudgedCovariance>& judged, double probability) {
  const auto count = std::count_if(judged.begin(), judged.end(), [&](const JudgedCovariance& one) {
    return one.probability <= probability;
  });
  return static_cast<double>(count) / static_cast<double>(judged.size());
}

}  // namespace

PoseErrorVector poseErrorVector(const Transform& estimate, const Transform& truth) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(estimate.linear() * truth.linear().transpose()));
  PoseErrorVector error;
  error << estimate.translation() - truth.translation(), turn.angle() * turn.axis();
  return error;
}

double chiSquareCdf(double x, int k) {
  if (!(x >= 0.0) || k < 1) throw InvalidParameter("chi-square: expected x >= 0 and k >= 1");
  const double half = x / 2.0;
  if (half > 700.0) return 1.0;  // beyond, the exponential is 0
  // The closed forms of whole degrees of freedom: a sum that rises by 1 in the exponent.
  const bool is_even = k % 2 == 0;
  double exponent = is_even ? 0.0 : 0.5;
  double term = std::exp(-half) * (is_even ? 1.0 : std::sqrt(half) / std::tgamma(1.5));
  double result = is_even ? 1.0 : std::erf(std::sqrt(half));
  for (int i = is_even ? 0 : 1; i < k / 2 + (is_even ? 0 : 1); ++i) {
    result -= term;
    exponent += 1.0;
    term *= half / exponent;
  }
  return std::clamp(result, 0.0, 1.0);
}

double chiSquareQuantile(double q, int k) {
  if (!(q > 0.0 && q < 1.0)) throw InvalidParameter("chi-square: expected 0 < q < 1");
  double low = 0.0;
  double high = 1.0;
  while (chiSquareCdf(high, k) < q) high *= 2.0;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = low + (high - low) / 2.0;
    if (middle == low || middle == high) break;
    (chiSquareCdf(middle, k) < q ? low : high) = middle;
  }
  return high;
}

std::optional<JudgedCovariance> judgeCovariance(const PoseErrorVector& error,
                                                const PoseCovariance& covariance) {
  const Matrix6 C = Eigen::Map<const Matrix6>(covariance.data());
  const auto axes = axesOf(C);
  if (!axes || !error.allFinite()) return std::nullopt;
  JudgedCovariance judged;
  judged.degrees = static_cast<int>(axes->size());
  // As correlations, so that metres and radians weigh alike in what counts as singular.
  Eigen::MatrixXd correlation(judged.degrees, judged.degrees);
  Eigen::VectorXd normalized(judged.degrees);
  for (int i = 0; i < judged.degrees; ++i) {
    const int a = (*axes)[static_cast<std::size_t>(i)];
    const double sigma = std::sqrt(C(a, a));
    normalized[i] = error[a] / sigma;
    judged.normalized[static_cast<std::size_t>(a)] = normalized[i];
    judged.deviations[static_cast<std::size_t>(a)] = sigma;
    for (int j = 0; j < judged.degrees; ++j) {
      const int b = (*axes)[static_cast<std::size_t>(j)];
      correlation(i, j) = (C(a, b) + C(b, a)) / 2.0 / sigma / std::sqrt(C(b, b));
    }
  }
  constexpr double kSingular = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation);
  if (eigen.info() != Eigen::Success || eigen.eigenvalues()[0] < kSingular) return std::nullopt;
  judged.nees = normalized.dot(correlation.ldlt().solve(normalized));
  judged.probability = chiSquareCdf(std::max(0.0, judged.nees), judged.degrees);
  return judged;
}

Proportion proportion(double value, std::size_t trials) {
  if (!(value >= 0.0 && value <= 1.0) || trials == 0) {
    throw InvalidParameter("proportion: expected a fraction, and one trial at least");
  }
  const double n = static_cast<double>(trials);
  const double z2 = kQuantile95 * kQuantile95;
  const double center = (value + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kQuantile95 / (1.0 + z2 / n) * std::sqrt(value * (1.0 - value) / n + z2 / (4.0 * n * n));
  return {value, std::max(0.0, center - half), std::min(1.0, center + half)};
}

Calibration calibrate(const std::vector<JudgedCovariance>& judged,
                      const std::vector<std::size_t>& units) {
  requireUnits(judged.size(), units.size());
  Calibration calibration;
  calibration.judged = judged.size();
  std::vector<double> ratios;
  for (const JudgedCovariance& one : judged) {
    calibration.mean_ratio += one.nees / one.degrees / static_cast<double>(judged.size());
    ratios.push_back(one.nees / chiSquareQuantile(0.5, one.degrees));
  }
  calibration.median_ratio = describe(ratios).median;
  const std::size_t trials = *std::max_element(units.begin(), units.end()) + 1;
  calibration.inside_50 = proportion(inside(judged, 0.5), trials);
  calibration.inside_95 = proportion(inside(judged, 0.95), trials);
  calibration.verdict = verdictOf(calibration, trials);
  return calibration;
}

std::vector<double> calibrationCurve(const std::vector<JudgedCovariance>& judged,
                                     const std::vector<double>& probabilities) {
  requireUnits(judged.size(), judged.size());
  std::vector<double> fractions;
  for (const double probability : probabilities) fractions.push_back(inside(judged, probability));
  return fractions;
}

AxisCalibration calibrateAxis(const std::vector<JudgedCovariance>& judged, std::size_t axis) {
  AxisCalibration result;
  std::vector<double> deviations;
  double squares = 0.0;
  for (const JudgedCovariance& one : judged) {
    const auto& normalized = one.normalized.at(axis);
    if (!normalized) continue;
    ++result.count;
    squares += *normalized * *normalized;
    result.inside_50 += std::abs(*normalized) <= kQuantile50 ? 1.0 : 0.0;
    result.inside_95 += std::abs(*normalized) <= kQuantile95 ? 1.0 : 0.0;
    deviations.push_back(one.deviations.at(axis));
  }
  if (result.count == 0) return result;
  const double n = static_cast<double>(result.count);
  result.rms_normalized = std::sqrt(squares / n);
  result.inside_50 /= n;
  result.inside_95 /= n;
  result.median_deviation = describe(deviations).median;
  return result;
}

}  // namespace pcrb
