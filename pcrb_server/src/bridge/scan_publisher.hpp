#pragma once

#include <pcrb_msgs/SubmitPose.h>

#include <deque>
#include <optional>
#include <string>

#include "bridge/answer_source.hpp"
#include "bridge/bridge_parameters.hpp"
#include "bridge/frames.hpp"
#include "bridge/robot_inputs.hpp"
#include "bridge/scan_schedule.hpp"

namespace pcrb {

/// One problem as it is put to a localization node.
struct LocalizationProblem {
  double time_limit = 0.0;  ///< s
  PointCloud source;        ///< as the server handed it out
  SensorMounting mounting;
  std::optional<Transform> initial_pose;  ///< T_map_base, if it was sent
};

/// Sends the scans of one problem and takes the node's answers, until one is accepted.
class ScanPublisher {
 public:
  /// @param known  the node's response time, from the problems before.
  ScanPublisher(const BridgeParameters& parameters, RobotInputs& inputs, const TfWatch& tf,
                const LocalizationProblem& problem, const ResponseTime& known);

  /// Sends a scan if one is due; kSubmit and kGiveUp: the problem is decided.
  ScanSchedule::Action step();

  /// s after which step() has something to do, if no pose comes.
  double timeToNext() const;

  /// A pose that the node published: an answer, if it belongs to a scan of the problem.
  void take(const PublishedPose& pose);

  /// Takes the poses that tf has connected since they came, for which they have half a second: a
  /// node may publish the transform that its pose needs after it. Also part of step().
  void takeWaiting();

  /// s for which the node may still be working on a scan of the problem.
  double timeToFinish() const { return schedule_.timeToFinish(steadyNow()); }

  /// The node's response time, this problem's answers included.
  ResponseTime responseTime() const { return schedule_.responseTimeAtEnd(steadyNow()); }

  /// Whether the node answered the problem's scans with a pose that could be used.
  bool isAnswered() const;

  /// A message of the node that is no pose.
  void note(AnswerFault fault, const std::string& text) { faults_.note(fault, text); }

  /// The poses that were no answers, those included that tf does not connect yet.
  AnswerDiagnosis faults() const;

  bool hasOnlyEchoed() const {
    return schedule_.convergence().hasEchoed() && !schedule_.convergence().latest();
  }

  int scansSent() const { return schedule_.scansSent(); }

  /// s since the first scan was to be sent.
  double elapsed() const { return steadyNow() - start_; }

  /// The decision; its pose is T_map_source.
  pcrb_msgs::SubmitPose::Request decision() const;

 private:
  struct Waiting {
    PublishedPose pose;
    double until;  ///< s, steady
  };

  std::vector<pcrb_msgs::ScanReply> scanReplies() const;
  bool use(const PublishedPose& pose);
  void noteStamp(std::int64_t stamp);
  std::optional<Transform> mapFrom(const PublishedPose& pose, const ros::Time& time) const;
  std::optional<Transform> baseIn(const std::string& frame, const ros::Time& time) const;

  const BridgeParameters& parameters_;
  RobotInputs& inputs_;
  const TfWatch& tf_;
  SensorMounting mounting_;
  ScanSchedule schedule_;
  std::vector<Transform> ways_;  ///< of the body from the first scan to each, from 1
  std::deque<Waiting> waiting_;  ///< poses that tf does not connect yet, oldest first
  std::string disconnected_;     ///< frames of the newest pose that tf did not connect
  AnswerDiagnosis faults_;
  double start_ = steadyNow();
};

}  // namespace pcrb
