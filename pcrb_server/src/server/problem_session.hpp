#pragma once

#include <pcrb_msgs/Ready.h>
#include <pcrb_msgs/SubmitPose.h>
#include <ros/time.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "pcrb_core/run/run_info.hpp"
#include "pcrb_core/run/scoring.hpp"
#include "pcrb_core/transform.hpp"
#include "server/replies.hpp"

namespace pcrb {

/// The problem in flight, between the server's loop and the threads of its services.
///
/// The loop announces a problem, waits for `ready`, publishes the source, waits for the reply; the
/// services call ready() and submit() at any time. All times are of the steady clock.
class ProblemSession {
 public:
  using Clock = std::chrono::steady_clock;

  /// T_target_frame at a time, or nothing where tf does not connect the two.
  using Lookup =
      std::function<std::optional<Transform>(const std::string& frame, const ros::Time& stamp)>;

  enum class Wait { kDone, kLimit, kSkipped, kStopped };

  /// @param handshake  with one, a problem belongs to the caller of its `ready`.
  ProblemSession(std::string target_frame, Lookup lookup, Handshake handshake = Handshake::kReady);

  // For the loop.
  void announce(const std::string& problem_id, const ros::Time& stamp);
  Wait waitReady(std::chrono::duration<double> limit);
  /// The source is published now; its replies are late after `limit`.
  void startClock(std::chrono::duration<double> limit);
  /// Waits for the reply and closes the problem; the reply says how it ended. kStopped: no reply
  /// was accepted before stop().
  Wait waitReply(Reply& reply);
  void endRun();

  // For the services.
  void ready(const std::string& caller, const pcrb_msgs::Ready::Request& request,
             pcrb_msgs::Ready::Response& response);
  void submit(const std::string& caller, const pcrb_msgs::SubmitPose::Request& request,
              pcrb_msgs::SubmitPose::Response& response);
  bool skip();  ///< whether there was a problem in flight to be skipped
  void stop();  ///< ends every wait, for good

  /// Name of the node that called ready() last; empty before.
  std::string client() const;

  /// Number of replies so far to problems in flight of nodes that had not called ready().
  std::uint64_t foreignReplies() const;

 private:
  class LookingUp;
  enum class Phase { kIdle, kAnnounced, kSourcePublished, kRunOver };

  std::optional<Rejection> check(const std::string& problem_id, Clock::time_point arrival) const;
  std::optional<Rejection> place(const pcrb_msgs::SubmitPose::Request& request,
                                 const Submission& submission, Clock::time_point arrival,
                                 std::unique_lock<std::mutex>& lock,
                                 std::optional<Transform>& T_target_frame);
  bool isElsewhere(const pcrb_msgs::SubmitPose::Request& request) const;
  Rejection noTransform(const pcrb_msgs::SubmitPose::Request& request) const;
  std::optional<Transform> toTarget(const pcrb_msgs::SubmitPose::Request& request,
                                    std::unique_lock<std::mutex>& lock);
  void accept(const Submission& submission, Clock::time_point arrival,
              const std::optional<Transform>& T_target_frame);
  Wait waitFor(std::unique_lock<std::mutex>& lock, Clock::time_point deadline,
               const std::function<bool()>& done);
  bool inFlight(const std::string& problem_id) const;
  bool isForeign(const std::string& caller) const;

  const std::string target_frame_;
  const Lookup lookup_;
  const Handshake handshake_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Phase phase_ = Phase::kIdle;
  std::string problem_id_;
  ros::Time stamp_;
  Clock::time_point published_;
  Clock::time_point deadline_;
  bool is_ready_ = false;
  bool is_skipped_ = false;
  bool is_stopped_ = false;
  std::string client_;
  std::uint64_t foreign_replies_ = 0;
  std::string last_rejection_;
  std::uint32_t rejected_ = 0;
  int looking_up_ = 0;  ///< replies that wait for tf
  std::optional<Reply> reply_;
  std::map<std::string, bool> ended_;  ///< id → whether a reply had been accepted
};

}  // namespace pcrb
