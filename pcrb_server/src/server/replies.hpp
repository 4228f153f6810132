#pragma once

#include <pcrb_msgs/SubmitPose.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "pcrb_core/run/scoring.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// Why a reply is not taken, as the response of SubmitPose says it.
struct Rejection {
  std::uint8_t code;
  std::string message;
};

/// Whether a node can have this name; a stranger may call itself anything.
bool isNodeName(const std::string& name);

/// A defect of a submission as a rejection.
std::optional<Rejection> toRejection(const std::optional<Defect>& defect);

/// Takes over what a request submits, of its reason what is printable of the first 4 KiB, and
/// checks what it says by itself (checkSubmission).
///
/// @param submission  set where nothing is returned.
std::optional<Rejection> readSubmission(const pcrb_msgs::SubmitPose::Request& request,
                                        Submission& submission);

/// Looks frames up for replies that come in another frame than the target's.
class TfLookup {
 public:
  /// @param keep  s of transforms to remember: a reply refers to its problem's stamp.
  TfLookup(std::string target_frame, double keep);

  /// T_target_frame at `stamp`, waiting up to 0.5 s for it; nothing if tf does not connect the two
  /// or holds numbers between them that are not finite. A few callers may wait at a time;
  /// further ones are answered from what is known, so that a flood cannot occupy every service
  /// thread.
  std::optional<Transform> operator()(const std::string& frame, const ros::Time& stamp);

 private:
  bool waitFor(const std::string& frame, const ros::Time& stamp);

  std::string target_frame_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  std::atomic<int> waiting_{0};
};

}  // namespace pcrb
