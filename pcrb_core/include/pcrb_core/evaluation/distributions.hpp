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

/// Quartiles of y for the values of x in [low, high).
struct QuantileBin {
  double low = 0.0;
  double high = 0.0;  ///< belongs to the last bin
  std::size_t count = 0;
  double q25 = 0.0;
  double median = 0.0;
  double q75 = 0.0;
};

/// How y spreads over x: bins that hold equally many values as far as equal x allow (they stay
/// together), so that none is empty.
///
/// @param bins  at most so many.
/// @throws InvalidParameter  if the lengths differ, a value is not finite, or bins is 0.
std::vector<QuantileBin> binnedQuantiles(const std::vector<double>& x, const std::vector<double>& y,
                                         std::size_t bins);

/// How one problem ended, as far as success is concerned.
struct ProblemOutcome {
  bool is_answered = false;        ///< a problem without a valid reply is never a success
  double error = 0.0;              ///< the benchmark's metric
  double rotation_error = 0.0;     ///< rad; NaN unknown
  double translation_error = 0.0;  ///< m; NaN unknown
};

/// Fraction of all attempts that are answered with an error of at most each threshold.
///
/// @param thresholds  ascending.
/// @return            one fraction per threshold, ascending; NaN where there is no attempt.
/// @throws InvalidParameter  if the thresholds are not ascending.
std::vector<double> fractionSolved(const std::vector<ProblemOutcome>& attempts,
                                   const std::vector<double>& thresholds);

/// Registration recall: the fraction of all attempts that are answered with at most these
/// translation (m) and rotation (rad) errors; NaN where there is no attempt or one is unknown.
double registrationRecall(const std::vector<ProblemOutcome>& attempts, double translation,
                          double rotation);

/// Thresholds from `low` to `high` at equal ratios, both included.
/// @throws InvalidParameter  unless 0 < low < high, both finite, and count >= 2.
std::vector<double> logarithmicSteps(double low, double high, std::size_t count);

}  // namespace pcrb
