#pragma once

#include <cstddef>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// A pose of the ground truth: T_world_body at a time. The rotation is kept as the log has it.
struct StampedPose {
  Stamp stamp = 0;
  Transform T_world_body = Transform::Identity();
};

/// Why a trajectory has or has no pose for a time.
enum class PoseStatus {
  kFound,
  kBeforeFirst,  ///< earlier than the first pose
  kAfterLast,    ///< later than the last pose
  kGap           ///< the poses around it are too far apart or away
};

/// For reports: `before the first pose` and so on.
const char* toString(PoseStatus status);

struct PoseLookup {
  PoseStatus status = PoseStatus::kGap;
  Transform T_world_body = Transform::Identity();  ///< meaningful with kFound only
};

/// Ground-truth poses over time.
class Trajectory {
 public:
  /// Sorts by stamp; of poses with one stamp the last is kept, as of replies to one problem.
  /// @throws InvalidProblem  if there is no pose.
  explicit Trajectory(std::vector<StampedPose> poses);

  /// The pose between the two around a time: translations linearly, rotations by slerp along the
  /// shorter arc, whatever the signs of the quaternions in the log.
  ///
  /// A stamp that a pose has gives that pose. Found only if the two are at most `max_gap` apart.
  PoseLookup interpolate(Stamp stamp, Stamp max_gap) const;

  /// The pose closest in time, the earlier one of two at the same distance; no limit.
  const StampedPose& nearest(Stamp stamp) const;

  /// The same, only for times within the trajectory or up to `max_distance` after its end, and only
  /// if the pose is at most `max_distance` away.
  PoseLookup nearest(Stamp stamp, Stamp max_distance) const;

  std::size_t size() const { return poses_.size(); }
  std::size_t duplicates() const { return duplicates_; }  ///< poses left out by the constructor
  std::vector<Stamp> stamps() const;                      ///< ascending
  Stamp firstStamp() const { return poses_.front().stamp; }
  Stamp lastStamp() const { return poses_.back().stamp; }

 private:
  std::vector<StampedPose> poses_;
  std::size_t duplicates_ = 0;
};

}  // namespace pcrb
