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

/// Result of Wilcoxon's signed-rank test.
struct PairedTest {
  std::size_t count = 0;  ///< differences that are not zero
  double positive = 0.0;  ///< rank sum of the positive differences
  double negative = 0.0;  ///< rank sum of the negative ones: the larger sum says the direction
  /// The size that goes with this test (Hodges and Lehmann): the median of the averages of all two
  /// differences that are not zero, each also with itself. Never of the direction's opposite sign.
  double pseudomedian = 0.0;
  double p_value = 1.0;  ///< two-sided, of differences that are symmetric about zero
};

/// Wilcoxon's signed-rank test of differences between two methods on the same units. Zeros are left
/// out. Exact for up to 50 differences that are left, tied or not; beyond, the normal approximation
/// with the ties' correction and without continuity correction, as scipy.stats.wilcoxon.
///
/// @throws InvalidParameter  if a difference is not finite.
/// Source: Wilcoxon, Individual comparisons by ranking methods, Biometrics Bulletin, 1945;
/// Hodges, Lehmann, Estimates of location based on rank tests, Annals of Mathematical Statistics,
/// 1963.
PairedTest wilcoxon(const std::vector<double>& differences);

/// Result of firstAgainstLater().
struct OrderTest {
  std::size_t groups = 0;   ///< of two values or more
  double p_value = 1.0;     ///< one-sided: of firsts that are as large or larger by chance
  double smallest_p = 1.0;  ///< where every first is the largest of its group
};

/// Tests whether the first values of groups are larger than the later ones, where each of a group's
/// values could have come first by the same chance: the sum of the firsts' ranks, against its exact
/// distribution over all firsts. Equal values share their ranks.
///
/// @param groups  each with its first value in front; those of one value say nothing.
/// @throws InvalidParameter  if a value is NaN.
OrderTest firstAgainstLater(const std::vector<std::vector<double>>& groups);

/// Holm's correction of the p-values of several tests: reject where the result is below the level,
/// and the chance of a single false rejection is below the level.
///
/// @throws InvalidParameter  unless all are in [0, 1].
/// Source: Holm, A simple sequentially rejective multiple test procedure, 1979.
std::vector<double> holmAdjusted(const std::vector<double>& p_values);

}  // namespace pcrb
