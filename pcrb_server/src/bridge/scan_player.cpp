#include "bridge/scan_player.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "bridge/body_frame.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pose_covariance.hpp"

namespace pcrb {

namespace {

using Request = pcrb_msgs::SubmitPose::Request;

constexpr double kNanoseconds = 1e9;       // in a second
constexpr double kTfLimit = 0.5;           // s for tf to connect a pose that came before it
constexpr std::size_t kMostWaiting = 100;  // poses

std::int64_t toNanoseconds(double seconds) { return std::llround(seconds * kNanoseconds); }

std::int64_t toNanoseconds(const ros::Time& time) {
  return static_cast<std::int64_t>(time.toNSec());
}

ros::Time toTime(std::int64_t nanoseconds) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(nanoseconds));
}

}  // namespace

double steadyNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ros::Time stampNow(StampClock& clock) { return toTime(clock.now(toNanoseconds(ros::Time::now()))); }

ScanPlayer::ScanPlayer(const BridgeParameters& parameters, NodeInputs& inputs, TfLinks& links,
                       const TfWatch& tf, StampClock& clock)
    : parameters_(parameters), inputs_(inputs), links_(links), tf_(tf), clock_(clock) {}

void ScanPlayer::begin(const ScanProblem& problem) {
  problem_ = problem;
  unusable_.clear();
  waiting_.clear();
  inputs_.setScan(problem.source, problem.T_scan_source);
  ScanPolicy policy = parameters_.scans;
  policy.deadline = parameters_.deadline_fraction * problem.time_limit;
  sequence_.emplace(policy, parameters_.settle, problem.initial_pose, steadyNow(), pace_);
}

void ScanPlayer::end() {
  pace_ = sequence_->paceAtEnd(steadyNow());
  sequence_.reset();
  waiting_.clear();
}

ScanSequence::Action ScanPlayer::step() {
  takeWaiting();
  const auto action = sequence_->next(steadyNow());
  if (action != ScanSequence::Action::kSendScan) return action;
  const std::int64_t time = toNanoseconds(ros::Time::now());
  const std::int64_t stamp = sequence_->scansSent() == 0
                                 ? clock_.now(time)
                                 : clock_.next(time, toNanoseconds(parameters_.scans.period));
  links_.sendDynamic(toTime(stamp));
  inputs_.sendMotion(toTime(stamp));
  inputs_.sendScan(toTime(stamp));
  sequence_->scanSent(steadyNow(), stamp);
  return action;
}

double ScanPlayer::patience() const { return sequence_->patience(steadyNow()); }

/// Takes a pose of any frame that tf connects with the base, in any that it connects with the map;
/// false if it does not yet.
bool ScanPlayer::use(const PublishedPose& pose) {
  const std::int64_t stamp = toNanoseconds(pose.stamp) - toNanoseconds(parameters_.answer_delay);
  const int scan = sequence_->scanOf(stamp);
  if (scan == 0) return true;
  const auto& p = parameters_;
  const ros::Time time = toTime(sequence_->stampOf(scan));
  const std::string& frame = pose.frame.empty() ? p.answer_frame : pose.frame;
  std::optional<Transform> T_map_parent = Transform::Identity();
  std::optional<Transform> T_frame_base = Transform::Identity();
  if (!pose.parent.empty() && pose.parent != p.map_frame) {
    T_map_parent = tf_.find(p.map_frame, pose.parent, time);
  }
  if (frame == p.scan_frame) {
    T_frame_base = problem_.T_base_scan.inverse();
  } else if (frame != p.base_frame) {
    T_frame_base = tf_.find(frame, p.base_frame, time);
  }
  if (!T_map_parent || !T_frame_base) {
    unusable_ = "tf does not connect the pose of `" + pose.frame + "` in `" + pose.parent +
                "` with `" + p.base_frame + "` and `" + p.map_frame + "`";
    return false;
  }
  const Transform T_map_frame = *T_map_parent * pose.T_parent_frame;
  std::optional<PoseCovariance> covariance;
  if (pose.covariance) {
    covariance = mountedCovariance(rotatedCovariance(*pose.covariance, T_map_parent->linear()),
                                   T_map_frame, *T_frame_base);
  }
  sequence_->answerReceived(steadyNow(), stamp, T_map_frame * *T_frame_base, covariance);
  return true;
}

void ScanPlayer::take(const PublishedPose& pose) {
  if (!sequence_) return;
  waiting_.push_back({pose, steadyNow() + kTfLimit});
  if (waiting_.size() > kMostWaiting) waiting_.pop_front();
  takeWaiting();
}

void ScanPlayer::takeWaiting() {
  const double now = steadyNow();
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    it = use(it->pose) || now >= it->until ? waiting_.erase(it) : std::next(it);
  }
}

bool ScanPlayer::isAnswered() const {
  return sequence_ && (sequence_->settling().latest() || sequence_->settling().hasEchoed());
}

Request ScanPlayer::decision() const {
  Request request;
  request.solver_time = std::nan("");
  request.reason = sequence_->reason(steadyNow());
  const auto& answer = sequence_->settling().latest();
  if (!answer) {
    request.status = Request::TIMED_OUT;
    if (!unusable_.empty()) request.reason += "; " + unusable_;
    return request;
  }
  const Transform T_base_source = problem_.T_base_source();
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
