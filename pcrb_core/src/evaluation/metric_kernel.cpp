#include "evaluation/metric_kernel.hpp"

#include "arithmetic.hpp"

#if defined(PCRB_HAS_CLONES)
#include <immintrin.h>
#endif

namespace pcrb {

namespace {

PCRB_CLONES
double sumOfNormsByCompiler(const PointArrays& points, const double* weights,
                            const Displacement& displacement) {
  return sumOfNormsBody(points, weights, displacement);
}

#if defined(PCRB_HAS_CLONES)

/// sumOfNormsBody in registers of eight doubles, which GCC makes two of four of.
__attribute__((target("avx512f"))) double sumOfNormsAvx512(const PointArrays& points,
                                                           const double* weights,
                                                           const Displacement& displacement) {
  constexpr __mmask8 kAll = 0xff;  // GCC 12 takes the plain calls for uses of what is not set
  const auto& [A, c, d] = displacement;
  const auto [x, y, z, size] = points;
  __m512d sums = _mm512_setzero_pd();
  for (std::size_t i = 0; i < size; i += kLanes) {
    const __m512d qx = _mm512_maskz_cvtps_pd(kAll, _mm256_loadu_ps(x + i)) - c[0];
    const __m512d qy = _mm512_maskz_cvtps_pd(kAll, _mm256_loadu_ps(y + i)) - c[1];
    const __m512d qz = _mm512_maskz_cvtps_pd(kAll, _mm256_loadu_ps(z + i)) - c[2];
    const __m512d dx = A[0][0] * qx + A[0][1] * qy + A[0][2] * qz + d[0];
    const __m512d dy = A[1][0] * qx + A[1][1] * qy + A[1][2] * qz + d[1];
    const __m512d dz = A[2][0] * qx + A[2][1] * qy + A[2][2] * qz + d[2];
    sums += _mm512_maskz_sqrt_pd(kAll, dx * dx + dy * dy + dz * dz) * _mm512_loadu_pd(weights + i);
  }
  double lanes[kLanes];
  _mm512_storeu_pd(lanes, sums);
  return sumOfLanes(lanes);
}

#endif

}  // namespace

double sumOfNorms(const PointArrays& points, const double* weights,
                  const Displacement& displacement) {
#if defined(PCRB_HAS_CLONES)
  static const bool has_avx512 = __builtin_cpu_supports("avx512f");
  if (has_avx512) return sumOfNormsAvx512(points, weights, displacement);
#endif
  return sumOfNormsByCompiler(points, weights, displacement);
}

}  // namespace pcrb
