#include "pcrb_core/datasets/sensor_scan.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace pcrb {

PointCounts& PointCounts::operator+=(const PointCounts& other) {
  read += other.read;
  non_finite += other.non_finite;
  at_origin += other.at_origin;
  malformed += other.malformed;
  return *this;
}

double pointTimeScale(std::string_view field, bool is_float) {
  constexpr std::array<std::string_view, 7> kNames = {
      "time", "t", "timestamp", "time_stamp", "offset_time", "time_offset", "point_time"};
  constexpr double kNanosecond = 1e-9;  // s
  if (std::count(kNames.begin(), kNames.end(), field) == 0) return 0.0;
  return is_float ? 1.0 : kNanosecond;
}

void movePoints(const Transform& T_dataset_sensor, std::vector<Eigen::Vector3d>& points) {
  const Eigen::Matrix3d R = T_dataset_sensor.linear();
  const Eigen::Vector3d t = T_dataset_sensor.translation();
  for (auto& point : points) point = R * point + t;
}

Transform asViewpoint(const Transform& T_dataset_sensor) {
  Transform viewpoint = T_dataset_sensor;
  viewpoint.linear() = nearestRotation(T_dataset_sensor.linear());
  return viewpoint;
}

DatasetCloud placeScan(SensorScan scan, const Transform& T_dataset_sensor) {
  movePoints(T_dataset_sensor, scan.points);
  DatasetCloud cloud;
  cloud.points = std::move(scan.points);
  cloud.viewpoint = asViewpoint(T_dataset_sensor);
  cloud.is_viewpoint_known = true;
  cloud.dropped_non_finite = scan.counts.non_finite;
  return cloud;
}

}  // namespace pcrb
