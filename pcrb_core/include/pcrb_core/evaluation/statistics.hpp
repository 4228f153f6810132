#pragma once

#include <cstddef>
#include <vector>

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

}  // namespace pcrb
