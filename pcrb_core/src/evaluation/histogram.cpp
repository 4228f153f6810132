#include "pcrb_core/evaluation/histogram.hpp"

#include <algorithm>
#include <cmath>

#include "pcrb_core/error.hpp"

namespace pcrb {

Histogram makeHistogram(const std::vector<double>& values, double min, double max,
                        std::size_t bins) {
  if (!std::isfinite(min) || !std::isfinite(max) || !(min < max) || bins == 0) {
    throw InvalidParameter("histogram: expected min < max, both finite, and at least one bin");
  }
  Histogram histogram;
  histogram.min = min;
  histogram.max = max;
  histogram.counts.assign(bins, 0);
  for (const double value : values) {
    if (std::isnan(value)) throw InvalidParameter("histogram: found NaN, expected numbers");
    if (value < min) {
      ++histogram.below;
    } else if (value > max) {
      ++histogram.above;
    } else {
      const double position = (value - min) / (max - min) * static_cast<double>(bins);
      ++histogram.counts[std::min(static_cast<std::size_t>(position), bins - 1)];
    }
  }
  return histogram;
}

}  // namespace pcrb
