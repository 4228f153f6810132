#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/pose_covariance.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

// Whether errors are as large as the covariances that came with the estimates say. Source:
// Bar-Shalom, Li, Kirubarajan, Estimation with Applications to Tracking and Navigation, 2001,
// section 5.4 (normalized estimation error squared, NEES).

/// x y z (m), rx ry rz (rad).
using PoseErrorVector = Eigen::Matrix<double, 6, 1>;

/// How an estimate differs from the truth, as a PoseCovariance counts it: difference of positions,
/// and the rotation vector that turns the true orientation into the estimated one, both about the
/// axes of the frame that the poses are in.
PoseErrorVector poseErrorVector(const Transform& estimate, const Transform& truth);

/// Distribution function of χ² with k degrees of freedom.
///
/// @param x  >= 0; infinite gives 1.
/// @param k  >= 1.
/// @throws InvalidParameter  if one is out of range.
double chiSquareCdf(double x, int k);

/// Its inverse.
///
/// @param q  in (0, 1).
/// @param k  >= 1.
/// @throws InvalidParameter  if one is out of range.
double chiSquareQuantile(double q, int k);

/// One error against its covariance.
struct JudgedCovariance {
  double nees = 0.0;         ///< eᵀ C⁻¹ e over the axes that have a variance
  int degrees = 6;           ///< number of those axes
  double probability = 0.0;  ///< that a NEES is at most this one, if the covariance is right
  std::array<std::optional<double>, 6> normalized;  ///< e / σ per axis that has a variance
  std::array<double, 6> deviations{};  ///< σ per axis, m and rad; 0 without a variance
};

/// Judges an error. Axes with variance 0 (and then without any covariance) are not estimated, as z,
/// roll and pitch of a planar node: they are left out.
///
/// @return  nothing if the covariance is none: not finite, not symmetric, with a negative variance,
///          without any variance, or not positive definite over its axes.
std::optional<JudgedCovariance> judgeCovariance(const PoseErrorVector& error,
                                                const PoseCovariance& covariance);

/// A fraction of independent trials with its 95 % interval.
struct Proportion {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Wilson's score interval.
/// @param value   fraction in [0, 1].
/// @param trials  number of independent trials, >= 1.
/// Source: Wilson, JASA 1927.
Proportion proportion(double value, std::size_t trials);

/// What the covariances of a run are worth.
struct Calibration {
  std::size_t judged = 0;
  double mean_ratio = 0.0;    ///< of NEES by its degrees: 1 is right, more is overconfident
  double median_ratio = 0.0;  ///< the same of medians: NEES by the median of its χ²
  Proportion inside_50;       ///< of the errors in the 50 % ellipsoid
  Proportion inside_95;
  std::string verdict;  ///< in words
};

/// @param judged  at least one.
/// @param units   number of the unit of each, from 0: errors of one pair of clouds depend on each
///                other, so that intervals are for as many trials as there are units.
/// @throws InvalidParameter  for none, or lists of different lengths.
Calibration calibrate(const std::vector<JudgedCovariance>& judged,
                      const std::vector<std::size_t>& units);

/// Fraction of errors that lie in the ellipsoid of each probability; of right covariances it is
/// that probability.
std::vector<double> calibrationCurve(const std::vector<JudgedCovariance>& judged,
                                     const std::vector<double>& probabilities);

/// One axis over a run.
struct AxisCalibration {
  std::size_t count = 0;
  double rms_normalized = 0.0;    ///< of e / σ: 1 is right, more is overconfident
  double median_deviation = 0.0;  ///< of the stated σ, m or rad
  double inside_50 = 0.0;         ///< fraction within ± 0.674 σ
  double inside_95 = 0.0;         ///< fraction within ± 1.960 σ
};

/// @param axis  0 … 5: x y z rx ry rz.
/// @return      count 0 where no covariance has that axis.
AxisCalibration calibrateAxis(const std::vector<JudgedCovariance>& judged, std::size_t axis);

}  // namespace pcrb
