#include "pcrb_core/datasets/trajectory.hpp"

#include <algorithm>
#include <utility>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

bool earlier(const StampedPose& pose, Stamp stamp) { return pose.stamp < stamp; }

Transform between(const StampedPose& a, const StampedPose& b, Stamp stamp) {
  const double share =
      static_cast<double>(stamp - a.stamp) / static_cast<double>(b.stamp - a.stamp);
  const Eigen::Quaterniond q_a(nearestRotation(a.T_world_body.linear()));
  const Eigen::Quaterniond q_b(nearestRotation(b.T_world_body.linear()));
  Transform T = Transform::Identity();
  T.linear() = q_a.slerp(share, q_b).normalized().toRotationMatrix();
  const Eigen::Vector3d step = b.T_world_body.translation() - a.T_world_body.translation();
  T.translation() = a.T_world_body.translation() + share * step;
  return T;
}

}  // namespace

const char* toString(PoseStatus status) {
  switch (status) {
    case PoseStatus::kFound:
      return "found";
    case PoseStatus::kBeforeFirst:
      return "before the first pose";
    case PoseStatus::kAfterLast:
      return "after the last pose";
    case PoseStatus::kGap:
      return "in a gap of the poses";
  }
  return "unknown";
}

Trajectory::Trajectory(std::vector<StampedPose> poses) : poses_(std::move(poses)) {
  if (poses_.empty()) throw InvalidProblem("a trajectory needs at least one pose");
  std::stable_sort(poses_.begin(), poses_.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  // From behind: of equal stamps the last one stays.
  const auto first_kept =
      std::unique(poses_.rbegin(), poses_.rend(), [](const auto& a, const auto& b) {
        return a.stamp == b.stamp;
      }).base();
  duplicates_ = static_cast<std::size_t>(first_kept - poses_.begin());
  poses_.erase(poses_.begin(), first_kept);
}

std::vector<Stamp> Trajectory::stamps() const {
  std::vector<Stamp> stamps;
  stamps.reserve(poses_.size());
  for (const StampedPose& pose : poses_) stamps.push_back(pose.stamp);
  return stamps;
}

PoseLookup Trajectory::interpolate(Stamp stamp, Stamp max_gap) const {
  if (stamp < firstStamp()) return {PoseStatus::kBeforeFirst, {}};
  if (stamp > lastStamp()) return {PoseStatus::kAfterLast, {}};
  const auto next = std::lower_bound(poses_.begin(), poses_.end(), stamp, earlier);
  if (next->stamp == stamp) return {PoseStatus::kFound, next->T_world_body};
  const auto previous = next - 1;
  if (next->stamp - previous->stamp > max_gap) return {PoseStatus::kGap, {}};
  return {PoseStatus::kFound, between(*previous, *next, stamp)};
}

const StampedPose& Trajectory::nearest(Stamp stamp) const {
  const auto next = std::lower_bound(poses_.begin(), poses_.end(), stamp, earlier);
  if (next == poses_.begin()) return *next;
  const auto previous = next - 1;
  if (next == poses_.end()) return *previous;
  return stamp - previous->stamp <= next->stamp - stamp ? *previous : *next;
}

PoseLookup Trajectory::nearest(Stamp stamp, Stamp max_distance) const {
  if (stamp < firstStamp()) return {PoseStatus::kBeforeFirst, {}};
  if (stamp > lastStamp() && stamp - lastStamp() > max_distance) {
    return {PoseStatus::kAfterLast, {}};
  }
  const StampedPose& pose = nearest(stamp);
  const Stamp distance = pose.stamp < stamp ? stamp - pose.stamp : pose.stamp - stamp;
  if (distance > max_distance) return {PoseStatus::kGap, {}};
  return {PoseStatus::kFound, pose.T_world_body};
}

}  // namespace pcrb
