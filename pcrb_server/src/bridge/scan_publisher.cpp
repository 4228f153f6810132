#include "bridge/scan_publisher.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

using Request = pcrb_msgs::SubmitPose::Request;

constexpr double kTfLimit = 0.5;           // s for tf to connect a pose that came before it
constexpr std::size_t kMostWaiting = 100;  // poses

ScanPolicy policyOf(const BridgeParameters& parameters, double time_limit) {
  ScanPolicy policy = parameters.scans;
  policy.deadline = parameters.deadline_fraction * time_limit;
  return policy;
}

}  // namespace

ScanPublisher::ScanPublisher(const BridgeParameters& parameters, RobotInputs& inputs,
                             const TfWatch& tf, const LocalizationProblem& problem,
                             const ResponseTime& known)
    : parameters_(parameters),
      inputs_(inputs),
      tf_(tf),
      mounting_(problem.mounting),
      schedule_(policyOf(parameters, problem.time_limit), parameters.settle, problem.initial_pose,
                steadyNow(), known) {
  inputs_.setScan(problem.source, mounting_);
}

ScanSchedule::Action ScanPublisher::step() {
  takeWaiting();
  const auto action = schedule_.next(steadyNow());
  if (action == ScanSchedule::Action::kSendScan) {
    const RobotInputs::SentScan scan = inputs_.sendScan(schedule_.scansSent() == 0);
    ways_.push_back(scan.T_first_base);
    schedule_.scanSent(steadyNow(), scan.stamp);
  }
  return action;
}

double ScanPublisher::timeToNext() const { return schedule_.timeToNext(steadyNow()); }

/// T_map_parent of a pose's parent frame.
std::optional<Transform> ScanPublisher::mapFrom(const PublishedPose& pose,
                                                const ros::Time& time) const {
  if (pose.parent.empty() || pose.parent == parameters_.map_frame) return Transform::Identity();
  return tf_.find(parameters_.map_frame, pose.parent, time);
}

/// T_frame_base.
std::optional<Transform> ScanPublisher::baseIn(const std::string& frame,
                                               const ros::Time& time) const {
  if (frame == parameters_.base_frame) return Transform::Identity();
  if (frame == parameters_.scan_frame) return mounting_.T_base_scan.inverse();
  return tf_.find(frame, parameters_.base_frame, time);
}

/// Takes a pose of any frame that tf connects with the base, in any that it connects with the map;
/// false if it does not yet.
bool ScanPublisher::use(const PublishedPose& pose) {
  const std::int64_t stamp = toNanoseconds(pose.stamp) - toNanoseconds(parameters_.answer_delay);
  const int scan = schedule_.scanOf(stamp);
  if (scan == 0) {
    noteStamp(stamp);
    return true;
  }
  const ros::Time time = toTime(schedule_.stampOf(scan));
  const auto T_map_parent = mapFrom(pose, time);
  const auto T_frame_base =
      baseIn(pose.frame.empty() ? parameters_.answer_frame : pose.frame, time);
  if (!T_map_parent || !T_frame_base) {
    disconnected_ = "tf does not connect the pose of `" + pose.frame + "` in `" + pose.parent +
                    "` with `" + parameters_.base_frame + "` and `" + parameters_.map_frame + "`";
    return false;
  }
  const Transform T_map_frame = *T_map_parent * pose.T_parent_frame;
  // The answer is where the body is now, the problem asks where it was at the first scan.
  const Transform T_frame_first =
      *T_frame_base * ways_[static_cast<std::size_t>(scan - 1)].inverse();
  std::optional<PoseCovariance> covariance;
  if (pose.covariance) {
    covariance = mountedCovariance(rotatedCovariance(*pose.covariance, T_map_parent->linear()),
                                   T_map_frame, T_frame_first);
  }
  schedule_.answerReceived(steadyNow(), stamp, T_map_frame * T_frame_first, covariance);
  return true;
}

/// A stamp before that of the first scan belongs to another problem.
void ScanPublisher::noteStamp(std::int64_t stamp) {
  for (int scan = scansSent(); scan > 0; --scan) {
    const std::int64_t lateness = stamp - schedule_.stampOf(scan);
    if (lateness >= 0) return faults_.noteStamp(static_cast<double>(lateness) * 1e-9);
  }
}

void ScanPublisher::take(const PublishedPose& pose) {
  waiting_.push_back({pose, steadyNow() + kTfLimit});
  if (waiting_.size() > kMostWaiting) waiting_.pop_front();
  takeWaiting();
}

void ScanPublisher::takeWaiting() {
  const double now = steadyNow();
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    const bool is_used = use(it->pose);
    const bool is_late = !is_used && now >= it->until;
    if (is_late) faults_.note(AnswerFault::kFrame, disconnected_);
    it = is_used || is_late ? waiting_.erase(it) : std::next(it);
  }
}

AnswerDiagnosis ScanPublisher::faults() const {
  AnswerDiagnosis faults = faults_;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    faults.note(AnswerFault::kFrame, disconnected_);
  }
  return faults;
}

bool ScanPublisher::isAnswered() const {
  return schedule_.convergence().latest() || schedule_.convergence().hasEchoed();
}

std::vector<pcrb_msgs::ScanReply> ScanPublisher::scanReplies() const {
  std::vector<pcrb_msgs::ScanReply> replies;
  for (const auto& scan : schedule_.scans()) {
    pcrb_msgs::ScanReply& reply = replies.emplace_back();
    reply.scan = static_cast<std::uint32_t>(replies.size());
    reply.sent = scan.sent - start_;
    reply.answered = std::nan("");
    if (scan.answered <= 0.0) continue;
    reply.answered = scan.answered - start_;
    reply.is_echo = scan.is_echo ? 1 : 0;
    reply.pose = toMessage(sensorPose(scan.T_map_body, mounting_.T_base_source()));
  }
  return replies;
}

Request ScanPublisher::decision() const {
  Request request;
  request.solver_time = std::nan("");
  request.reason = schedule_.reason(steadyNow());
  if (parameters_.stores_scans) request.scans = scanReplies();
  const auto& answer = schedule_.convergence().latest();
  if (!answer) {
    request.status = Request::TIMED_OUT;
    return request;
  }
  const Transform T_base_source = mounting_.T_base_source();
  request.status = Request::POSE;
  request.pose.pose = toMessage(sensorPose(answer->T_map_body, T_base_source));
  request.scans_used = static_cast<std::uint32_t>(answer->scan);
  if (answer->covariance) {
    const auto covariance =
        mountedCovariance(*answer->covariance, answer->T_map_body, T_base_source);
    request.has_covariance = 1;
    std::copy(covariance.begin(), covariance.end(), request.covariance.begin());
  }
  return request;
}

}  // namespace pcrb
