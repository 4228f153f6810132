#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "pcrb_core/point_cloud.hpp"

namespace pcrb {

/// What became of the points of a log.
struct PointCounts {
  std::size_t read = 0;        ///< points in the log, malformed lines included
  std::size_t non_finite = 0;  ///< left out: NaN, infinite, or a depth image's "no depth"
  std::size_t at_origin = 0;   ///< left out: exactly (0, 0, 0) in the sensor's frame
  std::size_t malformed = 0;   ///< left out: lines that are no point, where the format allows it

  std::size_t written() const { return read - non_finite - at_origin - malformed; }
  PointCounts& operator+=(const PointCounts& other);
};

/// What to do with returns at exactly (0, 0, 0), which some lidars give for "no return".
enum class OriginPoints { kKeep, kDrop };

/// Points of one scan as the log has them.
struct SensorScan {
  std::vector<Eigen::Vector3d> points;  ///< m, finite; in the sensor's frame unless said otherwise
  std::vector<double> times;  ///< s of each point, as the log has them; empty where it has none
  Transform viewpoint = Transform::Identity();  ///< of a PCD
  bool is_viewpoint_known = false;              ///< as DatasetCloud's
  PointCounts counts;
  std::vector<std::string> notes;  ///< of the reader: what it took although it is odd

  /// Counts a point and keeps it if it is one.
  /// @return  whether it was kept
  bool add(const Eigen::Vector3d& point, OriginPoints origin) {
    ++counts.read;
    if (!point.allFinite()) {
      ++counts.non_finite;
      return false;
    }
    if (origin == OriginPoints::kDrop && (point.array() == 0.0).all()) {
      ++counts.at_origin;
      return false;
    }
    points.push_back(point);
    return true;
  }
};

/// Moves points into the data set's frame, in double: p_dataset = T_dataset_sensor · p_sensor, with
/// the rotation as it is given.
void movePoints(const Transform& T_dataset_sensor, std::vector<Eigen::Vector3d>& points);

/// The pose as a VIEWPOINT: with the rotation nearest to the given one.
Transform asViewpoint(const Transform& T_dataset_sensor);

/// The scan in the data set's frame, with its pose as viewpoint.
DatasetCloud placeScan(SensorScan scan, const Transform& T_dataset_sensor);

}  // namespace pcrb
