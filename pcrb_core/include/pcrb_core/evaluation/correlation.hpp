#pragma once

#include <cstddef>
#include <vector>

namespace pcrb {

/// A rank correlation; NaN where it is not defined.
struct Correlation {
  std::size_t count = 0;
  double rho = 0.0;      ///< in [-1, 1]; NaN for fewer than 2 pairs, or if one side is constant
  double p_value = 0.0;  ///< two-sided, of ρ = 0; NaN for fewer than 3 pairs
};

/// Ranks from 1; equal values share the mean of their ranks.
std::vector<double> ranks(const std::vector<double>& values);

/// Spearman's ρ of two lists of the same length: Pearson's correlation of the ranks. The p-value is
/// that of Student's t with n − 2 degrees of freedom, as in scipy.stats.spearmanr.
///
/// @throws InvalidParameter  if the lengths differ or a value is NaN.
Correlation spearman(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace pcrb
