#pragma once

// The only public header that includes PCL: whoever includes it finds PCL themselves.

#include <pcl/point_cloud.h>

#include <Eigen/Core>
#include <vector>

#include "pcrb_core/evaluation/homologous_error.hpp"

namespace pcrb {

/// The benchmark's error of homologous PCL clouds, organized or not; see homologous_error.hpp.
///
/// @tparam PointT  has x, y, z, in m.
template <typename PointT>
double error(const pcl::PointCloud<PointT>& aligned, const pcl::PointCloud<PointT>& ground_truth) {
  const auto inDouble = [](const pcl::PointCloud<PointT>& cloud) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(cloud.size());
    for (const PointT& point : cloud) points.emplace_back(point.x, point.y, point.z);
    return points;
  };
  return error(inDouble(aligned), inDouble(ground_truth));
}

}  // namespace pcrb
