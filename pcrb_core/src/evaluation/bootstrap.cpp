#include "pcrb_core/evaluation/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

/// One value and its unit, in ascending order of values.
struct Entry {
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
double weightedMedian(const std::vector<Entry>& sorted, const std::vector<std::size_t>& drawn) {
  std::size_t total = 0;
  for (const Entry& entry : sorted) total += drawn[entry.unit];
  const std::size_t low_position = (total - 1) / 2, high_position = total / 2;
  std::size_t passed = 0;
  double low = 0.0;
  bool has_low = false;
  for (const Entry& entry : sorted) {
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
  std::vector<Entry> sorted;
  sorted.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sorted.push_back({values[i], units[i]});
  std::sort(sorted.begin(), sorted.end(),
            [](const Entry& a, const Entry& b) { return a.value < b.value; });
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

}  // namespace pcrb
