#pragma once

#include <pcrb_msgs/SubmitPose.h>

#include <cstdint>
#include <optional>
#include <string>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// Why a reply is not taken, as the response of SubmitPose says it.
struct Rejection {
  std::uint8_t code;
  std::string message;
};

/// Checks what a reply says by itself, whichever problem it is for: its status, that every number
/// can be scored and stored, that the quaternion is one of a rotation.
///
/// @return  nothing if it can be taken. A reply without a pose (status FAILED or TIMED_OUT) is
///          checked for its status and solver time alone.
std::optional<Rejection> checkContent(const pcrb_msgs::SubmitPose::Request& request);

/// Checks that a pose that passed checkContent() can still be scored in the target's frame.
std::optional<Rejection> checkPlaced(const pcrb_msgs::SubmitPose::Request& request,
                                     const Transform& T_target_frame);

}  // namespace pcrb
