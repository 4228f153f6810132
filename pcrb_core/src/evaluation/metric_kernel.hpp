#pragma once

#include <cmath>
#include <cstddef>

namespace pcrb {

/// Partial sums that are kept side by side: fixed, so that every instruction set adds in the same
/// order. Eight doubles fill the widest registers.
constexpr std::size_t kLanes = 8;

/// Points as three arrays, padded to a multiple of kLanes.
struct PointArrays {
  const float* x;
  const float* y;
  const float* z;
  std::size_t padded_size;
};

/// Where a transform takes a point p from: linear · (p − center) + offset.
struct Displacement {
  double linear[3][3];  ///< R − I
  double center[3];     ///< m
  double offset[3];     ///< m, what happens to the center
};

/// The partial sums added up, in the order that every version keeps.
__attribute__((always_inline)) inline double sumOfLanes(const double (&sums)[kLanes]) {
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// Σ weightᵢ · ‖displacement of pointᵢ‖; the padding's weights are 0.
///
/// This is the body of the function below, for callers that choose the instruction set.
__attribute__((always_inline)) inline double sumOfNormsBody(const PointArrays& points,
                                                            const double* weights,
                                                            const Displacement& displacement) {
  const auto& [A, c, d] = displacement;
  const auto [x, y, z, size] = points;
  double sums[kLanes] = {};
  for (std::size_t i = 0; i < size; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double qx = x[i + lane] - c[0];
      const double qy = y[i + lane] - c[1];
      const double qz = z[i + lane] - c[2];
      const double dx = A[0][0] * qx + A[0][1] * qy + A[0][2] * qz + d[0];
      const double dy = A[1][0] * qx + A[1][1] * qy + A[1][2] * qz + d[1];
      const double dz = A[2][0] * qx + A[2][1] * qy + A[2][2] * qz + d[2];
      sums[lane] += std::sqrt(dx * dx + dy * dy + dz * dz) * weights[i + lane];
    }
  }
  return sumOfLanes(sums);
}

/// sumOfNormsBody with the best instructions of the machine; the same bits on every machine.
double sumOfNorms(const PointArrays& points, const double* weights,
                  const Displacement& displacement);

}  // namespace pcrb
