#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcrb_core/evaluation/statistics.hpp"

namespace pcrb {

/// Quantile by linear interpolation between order statistics, at position q · (n − 1) (Hyndman and
/// Fan's type 7, as numpy).
///
/// @param sorted  ascending, not empty.
/// @param q       in [0, 1].
/// @throws InvalidParameter  if either is not so (the order is not checked).
double quantile(const std::vector<double>& sorted, double q);

/// The paper's statistics of a set of errors; NaN where there is no value.
struct Statistics {
  std::size_t count = 0;
  double median = 0.0;
  double q75 = 0.0;
  double q95 = 0.0;
  double mean = 0.0;
  double stddev = 0.0;  ///< with n in the denominator
};

/// Statistics of finite values in any order; the result does not depend on the order. Magnitudes up
/// to the largest double do no harm.
/// @throws InvalidParameter  if a value is not finite.
Statistics describe(std::vector<double> values);

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

struct BootstrapOptions {
  std::size_t resamples = 2000;
  double confidence = 0.95;
  std::uint64_t seed = 1;
};

/// Confidence interval of a median by the percentile bootstrap over units.
///
/// Values of one unit (the perturbations of a pair of clouds) depend on each other, so whole units
/// are drawn with replacement, as many as there are. The same input and seed give the same bits on
/// every platform.
/// @param values  finite.
/// @param units   number of the unit of each value: 0 … the number of units − 1, each used.
/// @return        NaN for fewer than two units.
/// @throws InvalidParameter  for lists of different lengths, a value that is not finite, a unit
///                           without a value, or options out of range.
/// Source: Efron, Tibshirani, An Introduction to the Bootstrap, 1993, section 13.3.
Interval medianInterval(const std::vector<double>& values, const std::vector<std::size_t>& units,
                        const BootstrapOptions& options = {});

/// How accurate a sequence's ground truth is, from the misalignments of its pairs.
struct GroundTruthAccuracy {
  std::vector<bool> is_outlier;  ///< one per misalignment, in their order
  std::size_t outliers = 0;
  Statistics kept;  ///< of the others, m
};

/// Values above the others by far: 0.6745 (x − median) / MAD > 3.5 (modified z-score, one-sided),
/// MAD being the median of |x − median|. Where MAD is 0 there are none.
///
/// @param values  finite, in any order.
/// @return        one per value, in their order.
/// @throws InvalidParameter  if a value is not finite.
/// Source: Fontana et al. 2021, section 4; Iglewicz, Hoaglin, How to detect and handle outliers,
/// 1993.
std::vector<bool> findOutliers(const std::vector<double>& values);

/// Outliers, and the mean and standard deviation (with n) of the rest: a row of the paper's Table
/// 1.
///
/// @param misalignments  m, one per pair: the mean distance that a registration which starts at the
///                       ground truth moves the source's points.
/// @throws InvalidParameter  if one is negative or not finite, or there is none.
GroundTruthAccuracy assessGroundTruth(const std::vector<double>& misalignments);

}  // namespace pcrb
