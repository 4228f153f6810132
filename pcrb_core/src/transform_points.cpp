#include <cstdint>
#include <cstring>

#include "pcrb_core/point_cloud.hpp"
#include "target_clones.hpp"

namespace pcrb {

namespace {

// A point's three coordinates (and one lane of padding) are moved at once; the compiler makes one
// or several instructions of it, whatever the processor has.
using Doubles = double __attribute__((vector_size(32)));
using Floats = float __attribute__((vector_size(16)));

PCRB_CLONES
void movePoints(const float* points, std::size_t count, const double* columns, std::uint8_t* out,
                std::size_t stride) {
  Doubles c[4];
  std::memcpy(c, columns, sizeof(c));
  for (std::size_t i = 0; i < count; ++i, points += 3, out += stride) {
    const Doubles moved = c[0] * static_cast<double>(points[0]) +
                          c[1] * static_cast<double>(points[1]) +
                          c[2] * static_cast<double>(points[2]) + c[3];
    const Floats rounded = __builtin_convertvector(moved, Floats);
    std::memcpy(out, &rounded, 3 * sizeof(float));
  }
}

}  // namespace

void transformPoints(const PointCloud& cloud, const Transform& T, std::uint8_t* out,
                     std::size_t stride) {
  if (cloud.points.empty()) return;
  const Eigen::Matrix4d columns = T.matrix();
  movePoints(cloud.points.front().data(), cloud.size(), columns.data(), out, stride);
}

}  // namespace pcrb
