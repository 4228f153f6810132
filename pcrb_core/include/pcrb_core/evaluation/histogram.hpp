#pragma once

#include <cstddef>
#include <vector>

namespace pcrb {

/// Counts in bins of equal width; bins are half-open, the last one is closed.
struct Histogram {
  double min = 0.0;
  double max = 1.0;
  std::vector<std::size_t> counts;
  std::size_t below = 0;  ///< values smaller than min
  std::size_t above = 0;  ///< values larger than max

  double width() const { return (max - min) / static_cast<double>(counts.size()); }
};

/// @throws InvalidParameter  unless min < max, both finite, bins > 0, and no value is NaN.
Histogram makeHistogram(const std::vector<double>& values, double min, double max,
                        std::size_t bins);

}  // namespace pcrb
