#pragma once

#include <cstddef>
#include <vector>

namespace pcrb {

/// What counts for success about one problem.
struct Attempt {
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
std::vector<double> fractionSolved(const std::vector<Attempt>& attempts,
                                   const std::vector<double>& thresholds);

/// Registration recall: the fraction of all attempts that are answered with at most these
/// translation (m) and rotation (rad) errors; NaN where there is no attempt or one is unknown.
double registrationRecall(const std::vector<Attempt>& attempts, double translation,
                          double rotation);

/// Thresholds from `low` to `high` at equal ratios, both included.
/// @throws InvalidParameter  unless 0 < low < high, both finite, and count >= 2.
std::vector<double> logarithmicSteps(double low, double high, std::size_t count);

}  // namespace pcrb
