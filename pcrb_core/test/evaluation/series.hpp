#pragma once

#include <cstddef>
#include <vector>

namespace pcrb_test {

/// The data of scipy_values.py: scattered numbers that C++ and Python compute to the same bits.
inline std::vector<double> series(std::size_t count, std::size_t factor, std::size_t modulus,
                                  double scale) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(static_cast<double>((i * factor + 13) % modulus) / scale);
  }
  return values;
}

}  // namespace pcrb_test
