#include "pcrb_core/point_cloud.hpp"

#include <cmath>
#include <sstream>

#include "pcrb_core/error.hpp"

namespace pcrb {

bool DatasetCloud::hasViewpoint() const { return !viewpoint.isApprox(Transform::Identity(), 0.0); }

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

}  // namespace pcrb
