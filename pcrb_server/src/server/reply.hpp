#pragma once

#include <pcrb_msgs/SubmitPose.h>

#include <array>
#include <optional>
#include <string>

#include "pcrb_core/evaluation/result.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// How a problem ended, as far as its client is concerned.
struct Reply {
  Outcome outcome = Outcome::kTimedOut;
  std::string reason;
  std::optional<double> runtime;                                    ///< s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< where kReplied
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< unit, where kReplied
  std::optional<std::array<double, 36>> covariance;
  std::optional<double> solver_time;  ///< s
  std::optional<std::uint32_t> scans_used;
  double cpu_time = 0.0;          ///< s, of the node under test for this problem, 0 = unknown
  std::uint64_t peak_memory = 0;  ///< bytes, of the node under test so far, 0 = unknown
  std::uint32_t rejected = 0;     ///< rejected replies to this problem before it ended
};

/// What an accepted request says, its quaternion normalised, pose and covariance in the target's
/// frame; online and offline alike.
///
/// @param T_target_frame  from the frame of its pose; nothing where that is the target's.
Reply makeReply(const pcrb_msgs::SubmitPose::Request& request,
                const std::optional<Transform>& T_target_frame);

}  // namespace pcrb
