#include "pcrb_core/datasets/sensor_scan.hpp"

#include <utility>

namespace pcrb {

PointCounts& PointCounts::operator+=(const PointCounts& other) {
  read += other.read;
  non_finite += other.non_finite;
  at_origin += other.at_origin;
  malformed += other.malformed;
  return *this;
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
  cloud.notes = std::move(scan.notes);
  return cloud;
}

}  // namespace pcrb
