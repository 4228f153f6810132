#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcrb {

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

}  // namespace pcrb
