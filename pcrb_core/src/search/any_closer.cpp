#include "search/any_closer.hpp"

#include "target_clones.hpp"

namespace pcrb {

PCRB_CLONES
bool anyCloser(const double* x, const double* y, const double* z, std::size_t n, const double* p,
               double squared_distance) {
  constexpr std::size_t kChunk = 16;
  const double px = p[0];
  const double py = p[1];
  const double pz = p[2];
  std::size_t i = 0;
  for (; i + kChunk <= n; i += kChunk) {
    int closer = 0;
    for (std::size_t j = i; j < i + kChunk; ++j) {
      const double dx = x[j] - px;
      const double dy = y[j] - py;
      const double dz = z[j] - pz;
      closer |= static_cast<int>(dx * dx + dy * dy + dz * dz < squared_distance);
    }
    if (closer != 0) return true;
  }
  for (; i < n; ++i) {
    const double dx = x[i] - px;
    const double dy = y[i] - py;
    const double dz = z[i] - pz;
    if (dx * dx + dy * dy + dz * dz < squared_distance) return true;
  }
  return false;
}

}  // namespace pcrb
