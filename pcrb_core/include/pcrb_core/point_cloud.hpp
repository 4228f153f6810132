#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// A cloud in its data set's frame and in double: what readers, converters and writers work on.
struct DatasetCloud {
  std::vector<Eigen::Vector3d> points;          ///< m, finite
  std::vector<float> intensity;                 ///< one per point, or empty where there is none
  Transform viewpoint = Transform::Identity();  ///< T_dataset_sensor, where it is known
  bool is_viewpoint_known = false;              ///< false: still known unless it is the identity
  std::size_t dropped_non_finite = 0;           ///< points left out on load: NaN or infinite
  std::vector<std::string> notes;               ///< of the reader: what it took although it is odd

  bool hasViewpoint() const;
};

/// A cloud for serving, registration and scoring: float offsets from a double origin.
///
/// p_dataset = p_local + local_origin. Points are finite.
struct PointCloud {
  std::vector<Eigen::Vector3f> points;  ///< m, relative to local_origin
  std::vector<float> intensity;         ///< one per point, or empty where there is none
  Eigen::Vector3d local_origin = Eigen::Vector3d::Zero();  ///< m, data set frame

  std::size_t size() const { return points.size(); }
};

/// Spacing of the grid that local origins lie on, m.
constexpr double kLocalOriginGrid = 100.0;

/// Largest distance of a coordinate from the local origin, m: beyond it float offsets lose too
/// much.
constexpr double kMaxSpan = 1500.0;

/// The grid point nearest to the centre of a target's bounding box.
///
/// From the target alone: the source's position would give its perturbation away.
/// @throws InvalidProblem  if the cloud is empty.
Eigen::Vector3d chooseLocalOrigin(const DatasetCloud& target);

/// The cloud relative to a local origin.
///
/// @throws InvalidProblem  if a coordinate is farther than kMaxSpan from the origin on any axis.
PointCloud makeLocal(const DatasetCloud& cloud, const Eigen::Vector3d& local_origin);

/// Centre of the points' bounding box, in whole metres, relative to the local origin: where people
/// look, and where an audit turns a target. Not the centroid, which is the secret pose of a scan
/// without a viewpoint when the same cloud is another problem's source. The origin for an empty
/// cloud.
Eigen::Vector3d boxCenter(const PointCloud& cloud);

/// Centroid of the points, relative to the local origin, summed in double in a fixed order.
///
/// @throws InvalidProblem  if the cloud is empty.
Eigen::Vector3d centroid(const PointCloud& cloud);

/// Centroid of the points in the data set's frame, summed relative to the first point, in a fixed
/// order.
///
/// @throws InvalidProblem  if the cloud is empty.
Eigen::Vector3d centroid(const DatasetCloud& cloud);

/// Writes T · p of every point as three floats, computed in double, each point `stride` bytes after
/// the one before it; the same bits on every processor.
///
/// @param out  room for size() · stride bytes.
void transformPoints(const PointCloud& cloud, const Transform& T, std::uint8_t* out,
                     std::size_t stride);

}  // namespace pcrb
