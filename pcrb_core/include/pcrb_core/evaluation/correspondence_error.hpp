#pragma once

#include <Eigen/Core>
#include <vector>

#include "pcrb_core/point_cloud.hpp"

namespace pcl {
template <typename PointT>
class PointCloud;  // whoever calls with one includes and finds PCL themselves
}  // namespace pcl

namespace pcrb {

/// The benchmark's error of corresponding clouds, δ = (1/n) Σ ‖p_i − g_i‖ / ‖p_i − p̄‖: point i of
/// one is point i of the other, p̄ is the centroid of the p_i. The aligned cloud need not be a rigid
/// image of the ground truth; for one that is, Metric gives the same from the transform alone.
///
/// Points within 1e-9 m of the centroid carry no weight and are left out of sum and n. Computed in
/// double relative to the first point, in a fixed order.
///
/// @param aligned       p_i, where a registration put the points, m.
/// @param ground_truth  g_i, where they belong, m, same frame, same length.
/// @return              dimensionless, >= 0, finite.
/// @throws InvalidProblem  if the lengths differ, a coordinate is not finite (the message has the
///                         point's index), or no point carries weight.
/// Source: Fontana et al. 2021, eq. 1.
double error(const std::vector<Eigen::Vector3d>& aligned,
             const std::vector<Eigen::Vector3d>& ground_truth);

/// The same for clouds relative to local origins, which may differ.
double error(const PointCloud& aligned, const PointCloud& ground_truth);

/// The same for PCL's clouds, organized or not.
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
