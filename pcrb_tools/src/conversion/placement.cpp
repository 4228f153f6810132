#include "conversion/placement.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "pcrb_core/io/file_bytes.hpp"

namespace pcrb_tools {
namespace {

std::string identityOfPoses(const pcrb::Trajectory& trajectory) {
  pcrb::Fnv1a hash;
  for (const pcrb::Stamp stamp : trajectory.stamps()) {
    hash.add(std::to_string(stamp) + poseText(trajectory.nearest(stamp).T_world_body));
  }
  return ' ' + std::to_string(hash.value());
}

}  // namespace

pcrb::PoseLookup Placement::sensorAt(pcrb::Stamp stamp) const {
  pcrb::PoseLookup pose = body(stamp);
  if (pose.status != pcrb::PoseStatus::kFound) return pose;
  pose.T_world_body = pose.T_world_body * T_body_sensor;
  if (!world) return pose;
  const pcrb::PoseLookup moved = world(stamp);
  if (moved.status != pcrb::PoseStatus::kFound) return moved;
  pose.T_world_body = moved.T_world_body * pose.T_world_body;
  return pose;
}

pcrb::PoseStatus Placement::find(pcrb::Stamp stamp, ScanPlace& place) const {
  const pcrb::PoseLookup sensor = sensorAt(stamp);
  if (sensor.status != pcrb::PoseStatus::kFound) return sensor.status;
  place.T_world_sensor = sensor.T_world_body;
  if (!in_world) {
    place.T_world_cloud = sensor.T_world_body;
  } else if (world) {
    place.T_world_cloud = world(stamp).T_world_body;
  }
  return pcrb::PoseStatus::kFound;
}

Placement placementBy(pcrb::PoseAt body, std::vector<pcrb::Stamp> stamps,
                      const OwnRequest& request) {
  const auto offset = static_cast<pcrb::Stamp>(
      std::llround(request.time_offset * static_cast<double>(pcrb::kSecond)));
  Placement placement;
  placement.body = [body = std::move(body), offset](pcrb::Stamp stamp) {
    return body(stamp - offset);
  };
  placement.stamps = std::move(stamps);
  for (pcrb::Stamp& stamp : placement.stamps) stamp += offset;
  placement.in_world = request.in_world;
  placement.T_body_sensor = request.T_body_sensor.value_or(pcrb::Transform::Identity());
  placement.identity = std::to_string(offset);
  return placement;
}

Placement placementBy(const pcrb::Trajectory& trajectory, const OwnRequest& request) {
  const auto poses = std::make_shared<const pcrb::Trajectory>(trajectory);
  Placement placement = placementBy(
      [poses, gap = request.max_gap](pcrb::Stamp stamp) { return poses->interpolate(stamp, gap); },
      trajectory.stamps(), request);
  placement.duplicates = trajectory.duplicates();
  if (request.deskew) placement.identity += identityOfPoses(trajectory);
  return placement;
}

ScanThinner::ScanThinner(const OwnRequest& request, Conversion& conversion)
    : conversion_(conversion), min_distance_(request.min_distance), limiter_(request.max_rate) {}

bool ScanThinner::keep(const std::string& name, std::optional<pcrb::Stamp> stamp,
                       const pcrb::Transform& T_world_sensor) {
  const Eigen::Vector3d place = T_world_sensor.translation();
  if (last_ && (place - *last_).norm() < min_distance_) {
    conversion_.drop(name, "closer to the one before than the minimal distance");
    return false;
  }
  if (stamp && !limiter_.keep(*stamp)) {
    conversion_.drop(name, "beyond the maximal rate");
    return false;
  }
  last_ = place;
  return true;
}

}  // namespace pcrb_tools
