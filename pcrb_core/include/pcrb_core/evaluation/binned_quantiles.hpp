#pragma once

#include <cstddef>
#include <vector>

namespace pcrb {

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

}  // namespace pcrb
