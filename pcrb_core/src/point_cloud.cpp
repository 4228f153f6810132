#include "pcrb_core/point_cloud.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "arithmetic.hpp"
#include "pcrb_core/error.hpp"

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

}  // namespace

void transformPoints(const PointCloud& cloud, const Transform& T, std::uint8_t* out,
                     std::size_t stride) {
  if (cloud.points.empty()) return;
  const Eigen::Matrix4d columns = T.matrix();
  movePoints(cloud.points.front().data(), cloud.size(), columns.data(), out, stride);
}

}  // namespace pcrb
