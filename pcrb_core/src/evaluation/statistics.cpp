#include "pcrb_core/evaluation/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

/// Power of two that brings all magnitudes to at most 1, so that sums and squares stay finite.
int scalingExponent(const std::vector<double>& sorted) {
  int exponent = 0;
  std::frexp(std::max(std::abs(sorted.front()), std::abs(sorted.back())), &exponent);
  return exponent;
}

/// Sets mean and standard deviation; the values' order is their sorted one, hence so are the bits.
void describeMoments(const std::vector<double>& sorted, Statistics& statistics) {
  const int exponent = scalingExponent(sorted);
  const double count = static_cast<double>(sorted.size());
  double sum = 0.0;
  for (const double value : sorted) sum += std::ldexp(value, -exponent);
  const double mean = sum / count;
  double squares = 0.0;
  for (const double value : sorted) {
    const double deviation = std::ldexp(value, -exponent) - mean;
    squares += deviation * deviation;
  }
  statistics.mean = std::clamp(std::ldexp(mean, exponent), sorted.front(), sorted.back());
  statistics.stddev = std::ldexp(std::sqrt(squares / count), exponent);
}

}  // namespace

double quantile(const std::vector<double>& sorted, double q) {
  if (sorted.empty()) throw InvalidParameter("quantile: found no values, expected at least one");
  if (!(q >= 0.0 && q <= 1.0)) {
    throw InvalidParameter("quantile: found " + std::to_string(q) + ", expected 0 to 1");
  }
  const double position = q * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(position);
  const double fraction = position - static_cast<double>(below);
  if (fraction == 0.0) return sorted[below];
  return sorted[below] + fraction * (sorted[below + 1] - sorted[below]);
}

Statistics describe(std::vector<double> values) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {0, kNaN, kNaN, kNaN, kNaN, kNaN};
  for (const double value : values) {
    if (!std::isfinite(value)) {
      throw InvalidParameter("statistics: found " + std::to_string(value) +
                             ", expected finite values");
    }
  }
  std::sort(values.begin(), values.end());
  Statistics statistics;
  statistics.count = values.size();
  statistics.median = quantile(values, 0.5);
  statistics.q75 = quantile(values, 0.75);
  statistics.q95 = quantile(values, 0.95);
  describeMoments(values, statistics);
  return statistics;
}

namespace {

/// One value and its unit, in ascending order of values.
struct ValueOfUnit {
  double value;
  std::size_t unit;
};

void requireUsable(const std::vector<double>& values, const std::vector<std::size_t>& units,
                   const BootstrapOptions& options) {
  if (values.size() != units.size()) {
    throw InvalidParameter("bootstrap: found " + std::to_string(values.size()) + " values and " +
                           std::to_string(units.size()) + " units, expected as many");
  }
  if (options.resamples == 0 || !(options.confidence > 0.0 && options.confidence < 1.0)) {
    throw InvalidParameter("bootstrap: expected at least one resample and a confidence in (0, 1)");
  }
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
    throw InvalidParameter("bootstrap: expected finite values");
  }
}

std::size_t countUnits(const std::vector<std::size_t>& units) {
  std::vector<bool> is_used;
  for (const std::size_t unit : units) {
    if (unit >= units.size()) throw InvalidParameter("bootstrap: expected units without gaps");
    if (unit >= is_used.size()) is_used.resize(unit + 1, false);
    is_used[unit] = true;
  }
  if (std::find(is_used.begin(), is_used.end(), false) != is_used.end()) {
    throw InvalidParameter("bootstrap: expected units without gaps");
  }
  return is_used.size();
}

/// Median of sorted entries, each taken as often as its unit was drawn.
double weightedMedian(const std::vector<ValueOfUnit>& sorted,
                      const std::vector<std::size_t>& drawn) {
  std::size_t total = 0;
  for (const ValueOfUnit& entry : sorted) total += drawn[entry.unit];
  const std::size_t low_position = (total - 1) / 2, high_position = total / 2;
  std::size_t passed = 0;
  double low = 0.0;
  bool has_low = false;
  for (const ValueOfUnit& entry : sorted) {
    passed += drawn[entry.unit];
    if (!has_low && passed > low_position) {
      low = entry.value;
      has_low = true;
    }
    if (passed > high_position) return low + 0.5 * (entry.value - low);
  }
  return low;
}

}  // namespace

Interval medianInterval(const std::vector<double>& values, const std::vector<std::size_t>& units,
                        const BootstrapOptions& options) {
  requireUsable(values, units, options);
  const std::size_t count = countUnits(units);
  if (count < 2) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    return {kNaN, kNaN};
  }
  std::vector<ValueOfUnit> sorted;
  sorted.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sorted.push_back({values[i], units[i]});
  std::sort(sorted.begin(), sorted.end(),
            [](const ValueOfUnit& a, const ValueOfUnit& b) { return a.value < b.value; });
  Random random(options.seed);
  std::vector<double> medians(options.resamples);
  std::vector<std::size_t> drawn(count);
  for (double& median : medians) {
    std::fill(drawn.begin(), drawn.end(), std::size_t{0});
    for (std::size_t i = 0; i < count; ++i) ++drawn[static_cast<std::size_t>(random.below(count))];
    median = weightedMedian(sorted, drawn);
  }
  std::sort(medians.begin(), medians.end());
  const double tail = (1.0 - options.confidence) / 2.0;
  return {quantile(medians, tail), quantile(medians, 1.0 - tail)};
}

std::vector<bool> findOutliers(const std::vector<double>& values) {
  constexpr double kNormalQuartile = 0.6745;  // MAD of the standard normal distribution
  constexpr double kLargestScore = 3.5;
  std::vector<bool> outliers(values.size(), false);
  if (values.empty()) return outliers;
  const double median = describe(values).median;
  std::vector<double> deviations;
  for (const double value : values) deviations.push_back(std::abs(value - median));
  const double mad = describe(deviations).median;
  for (std::size_t i = 0; i < values.size() && mad > 0.0; ++i) {
    outliers[i] = kNormalQuartile * (values[i] - median) / mad > kLargestScore;
  }
  return outliers;
}

GroundTruthAccuracy assessGroundTruth(const std::vector<double>& misalignments) {
  if (misalignments.empty()) {
    throw InvalidParameter("ground truth: found no misalignment, expected at least one");
  }
  for (const double misalignment : misalignments) {
    if (!(misalignment >= 0.0)) {
      throw InvalidParameter("ground truth: found a misalignment of " +
                             std::to_string(misalignment) + " m, expected at least 0");
    }
  }
  GroundTruthAccuracy accuracy;
  accuracy.is_outlier = findOutliers(misalignments);
  std::vector<double> kept;
  for (std::size_t i = 0; i < misalignments.size(); ++i) {
    if (accuracy.is_outlier[i]) {
      ++accuracy.outliers;
    } else {
      kept.push_back(misalignments[i]);
    }
  }
  accuracy.kept = describe(kept);
  return accuracy;
}

}  // namespace pcrb
