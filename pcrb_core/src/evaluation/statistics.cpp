#include "pcrb_core/evaluation/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "pcrb_core/error.hpp"

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

}  // namespace pcrb
