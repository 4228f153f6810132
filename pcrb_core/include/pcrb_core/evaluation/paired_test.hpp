#pragma once

#include <cstddef>
#include <vector>

namespace pcrb {

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

/// Holm's correction of the p-values of several tests: reject where the result is below the level,
/// and the chance of a single false rejection is below the level.
///
/// @throws InvalidParameter  unless all are in [0, 1].
/// Source: Holm, A simple sequentially rejective multiple test procedure, 1979.
std::vector<double> holmAdjusted(const std::vector<double>& p_values);

}  // namespace pcrb
