#include "pcrb_core/point_cloud.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "arithmetic.hpp"
#include "pcrb_core/error.hpp"

#if defined(PCRB_HAS_CLONES)
#include <immintrin.h>
#endif

namespace pcrb {

bool DatasetCloud::hasViewpoint() const {
  return is_viewpoint_known || !viewpoint.isApprox(Transform::Identity(), 0.0);
}

Eigen::Vector3d chooseLocalOrigin(const DatasetCloud& target) {
  if (target.points.empty()) throw InvalidProblem("target cloud has no points");
  Eigen::AlignedBox3d box;
  for (const auto& point : target.points) box.extend(point);
  return (box.center() / kLocalOriginGrid).array().round() * kLocalOriginGrid;
}

PointCloud makeLocal(const DatasetCloud& cloud, const Eigen::Vector3d& local_origin) {
  PointCloud local;
  local.local_origin = local_origin;
  local.intensity = cloud.intensity;
  local.points.reserve(cloud.points.size());
  for (const auto& point : cloud.points) {
    const Eigen::Vector3d offset = point - local_origin;
    if (!(offset.lpNorm<Eigen::Infinity>() <= kMaxSpan)) {
      std::ostringstream message;
      message << "found a point " << offset.lpNorm<Eigen::Infinity>()
              << " m from the target's local origin, expected at most " << kMaxSpan
              << " m: do source and target belong to the same frame?";
      throw InvalidProblem(message.str());
    }
    local.points.push_back(offset.cast<float>());
  }
  return local;
}

Eigen::Vector3d boxCenter(const PointCloud& cloud) {
  if (cloud.points.empty()) return Eigen::Vector3d::Zero();
  Eigen::AlignedBox3f box;
  for (const auto& point : cloud.points) box.extend(point);
  return box.center().cast<double>().array().round();
}

Eigen::Vector3d centroid(const PointCloud& cloud) {
  if (cloud.points.empty()) throw InvalidProblem("cloud has no points");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : cloud.points) sum += point.cast<double>();
  return sum / static_cast<double>(cloud.points.size());
}

Eigen::Vector3d centroid(const DatasetCloud& cloud) {
  if (cloud.points.empty()) throw InvalidProblem("cloud has no points");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : cloud.points) sum += point - cloud.points.front();
  return cloud.points.front() + sum / static_cast<double>(cloud.points.size());
}

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

#if defined(PCRB_HAS_CLONES)

constexpr std::size_t kBlock = 8;  // points that the loop below moves at once

// GCC 12 warns of the plain forms of some of these calls, as if they used what is not set.
constexpr __mmask8 kAll = 0xff;

__attribute__((target("avx512f"))) inline __m256 lowHalf(__m512 values) {
  return _mm256_castpd_ps(_mm512_maskz_extractf64x4_pd(kAll, _mm512_castps_pd(values), 0));
}

__attribute__((target("avx512f"))) inline __m512 fromHalves(__m256 low, __m256 high) {
  const __m512d lower =
      _mm512_maskz_insertf64x4(kAll, _mm512_setzero_pd(), _mm256_castps_pd(low), 0);
  return _mm512_castpd_ps(_mm512_maskz_insertf64x4(kAll, lower, _mm256_castps_pd(high), 1));
}

/// movePoints() of whole blocks of points that lie one after the other: no lane is empty.
__attribute__((target("avx512f"))) void moveBlocks(const float* points, std::size_t blocks,
                                                   const double* columns, std::uint8_t* out) {
  const __m512i x = _mm512_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21, 0, 0, 0, 0, 0, 0, 0, 0);
  const __m512i places[3] = {x, _mm512_add_epi32(x, _mm512_set1_epi32(1)),
                             _mm512_add_epi32(x, _mm512_set1_epi32(2))};
  // Of x at 0 to 7, y at 8 to 15, z at 16 to 23.
  const __m512i front = _mm512_setr_epi32(0, 8, 16, 1, 9, 17, 2, 10, 18, 3, 11, 19, 4, 12, 20, 5);
  const __m512i back = _mm512_setr_epi32(13, 21, 6, 14, 22, 7, 15, 23, 0, 0, 0, 0, 0, 0, 0, 0);
  for (; blocks > 0; --blocks, points += 3 * kBlock, out += 3 * kBlock * sizeof(float)) {
    const __m512 a = _mm512_loadu_ps(points);
    const __m512 b = _mm512_maskz_loadu_ps(0xff, points + 16);
    __m512d p[3];
    for (int axis = 0; axis < 3; ++axis) {
      const __m512 taken = _mm512_permutex2var_ps(a, places[axis], b);
      p[axis] = _mm512_maskz_cvtps_pd(kAll, lowHalf(taken));
    }
    __m256 q[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double* c = columns + axis;
      q[axis] = _mm512_maskz_cvtpd_ps(kAll, c[0] * p[0] + c[4] * p[1] + c[8] * p[2] + c[12]);
    }
    const __m512 xy = fromHalves(q[0], q[1]);
    const __m512 z = fromHalves(q[2], q[2]);
    _mm512_storeu_ps(out, _mm512_permutex2var_ps(xy, front, z));
    const __m256 rest = lowHalf(_mm512_permutex2var_ps(xy, back, z));
    _mm256_storeu_ps(reinterpret_cast<float*>(out + 16 * sizeof(float)), rest);
  }
}

#endif

}  // namespace

void transformPoints(const PointCloud& cloud, const Transform& T, std::uint8_t* out,
                     std::size_t stride) {
  if (cloud.points.empty()) return;
  const Eigen::Matrix4d columns = T.matrix();
  const float* points = cloud.points.front().data();
  std::size_t moved = 0;
#if defined(PCRB_HAS_CLONES)
  if (stride == 3 * sizeof(float) && __builtin_cpu_supports("avx512f")) {
    moveBlocks(points, cloud.size() / kBlock, columns.data(), out);
    moved = cloud.size() / kBlock * kBlock;
  }
#endif
  movePoints(points + 3 * moved, cloud.size() - moved, columns.data(), out + stride * moved,
             stride);
}

}  // namespace pcrb
