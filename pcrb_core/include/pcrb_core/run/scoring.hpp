#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/pose_covariance.hpp"
#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/run/result.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// What a client submits to a problem, as it came: nothing of it is checked.
struct Submission {
  enum class Status { kPose, kFailed, kTimedOut };

  Status status = Status::kPose;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m, in the pose's frame
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< as sent, of any norm
  std::optional<PoseCovariance> covariance;
  std::optional<double> solver_time;  ///< s
  std::uint32_t scans_used = 0;       ///< 0 = unknown
  double cpu_time = 0.0;              ///< s, of the node under test for this problem, 0 = unknown
  std::uint64_t peak_memory = 0;      ///< bytes, of the node under test so far, 0 = unknown
  std::vector<ScanRecord> scans;      ///< of a localization node, poses as sent; without errors
  std::string reason;
};

/// Why a submission cannot be taken.
struct Defect {
  enum class Kind { kNotFinite, kNotUnitQuaternion };

  Kind kind;
  std::string message;
};

/// Checks what a submission says by itself, whichever problem it is for: that every number can be
/// scored and stored, that the quaternion is one of a rotation (norm 1 ± 1e-3).
///
/// @return  nothing if it can be taken. Of a submission without a pose only its times are checked.
std::optional<Defect> checkSubmission(const Submission& submission);

/// Checks that the pose of a submission that passed checkSubmission() can still be scored in the
/// target's frame.
std::optional<Defect> checkPlaced(const Submission& submission, const Transform& T_target_frame);

/// How a problem ended, as far as its client is concerned.
struct Reply {
  Outcome outcome = Outcome::kTimedOut;
  std::string reason;
  std::optional<double> runtime;                                    ///< s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< where kReplied
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< unit, where kReplied
  std::optional<PoseCovariance> covariance;
  std::optional<double> solver_time;  ///< s
  std::optional<std::uint32_t> scans_used;
  double cpu_time = 0.0;          ///< s, of the node under test for this problem, 0 = unknown
  std::uint64_t peak_memory = 0;  ///< bytes, of the node under test so far, 0 = unknown
  std::vector<ScanRecord> scans;  ///< of a localization node, without errors
  std::uint32_t rejected = 0;     ///< rejected replies to this problem before it ended
};

/// What an accepted submission says, its quaternion normalised, pose and covariance in the target's
/// frame; online and offline alike.
///
/// @param T_target_frame  from the frame of its pose; nothing where that is the target's.
Reply makeReply(const Submission& submission, const std::optional<Transform>& T_target_frame);

/// The row of a problem, finished now: the same bits for the same pose, online and offline. Without
/// a pose the initial guess is scored.
Result score(const PosedProblem& posed, const Reply& reply);

/// The pose that a row was scored with: the accepted one, or without one the initial guess.
Transform scoredPose(const PosedProblem& posed, const Result& result);

}  // namespace pcrb
