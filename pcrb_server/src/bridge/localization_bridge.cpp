#include "bridge/localization_bridge.hpp"

#include <ros/callback_queue.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "bridge/body_frame.hpp"
#include "bridge/empty_call.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/result.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

using Request = pcrb_msgs::SubmitPose::Request;

constexpr double kPollPeriod = 0.02;       // s
constexpr double kReminderPeriod = 5.0;    // s
constexpr double kInitialPoseLimit = 5.0;  // s for a new node to subscribe to the initial pose
constexpr double kForever = 1e9;           // s

}  // namespace

LocalizationBridge::LocalizationBridge(const BridgeParameters& parameters, ShutdownNotice& shutdown)
    : parameters_(parameters),
      shutdown_(shutdown),
      inputs_(node_, parameters),
      links_(parameters),
      tf_(node_, links_.ownedChildren(),
          [this](const geometry_msgs::TransformStamped& transform) { takeTransform(transform); }),
      clock_(parameters.has_even_stamps),
      player_(parameters, inputs_, links_, tf_, clock_),
      keeper_(node_, parameters, inputs_),
      rivals_({node_.resolveName(parameters.map_topic), node_.resolveName(parameters.scan_topic)},
              node_.resolveName(parameters.initialpose_topic),
              [this](const std::string& node) { return inputs_.isObserver(node); }),
      server_(nullptr) {
  if (parameters.pose_topic.empty()) return;
  answers_.emplace(node_, parameters.pose_topic,
                   [this](const PublishedPose& pose) { player_.take(pose); });
}

/// Works off callbacks until the condition holds, for at most `limit` s; false if it does not by
/// then, or the bridge shuts down.
bool LocalizationBridge::waitFor(const Condition& condition, double limit) {
  const double end = steadyNow() + limit;
  while (!shutdown_.requested() && !condition()) {
    const double rest = end - steadyNow();
    if (rest <= 0.0) return false;
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(std::min(rest, kPollPeriod)));
  }
  return !shutdown_.requested();
}

/// Waits as long as the problem is the newest one, and says on standard output what for.
bool LocalizationBridge::waitWhileCurrent(const Condition& condition, const std::string& what) {
  const auto is_over = [&] { return condition() || !isCurrent(); };
  while (!waitFor(is_over, kReminderPeriod)) {
    if (shutdown_.requested()) return false;
    std::cout << "waiting for " << what << std::endl;
    rivals_.refuse(tf_.rival());
  }
  return isCurrent();
}

void LocalizationBridge::pause(double seconds) {
  waitFor(
      [this] {
        inputs_.sendMotion(stampNow(clock_));
        return false;
      },
      seconds);
}

bool LocalizationBridge::isCurrent() const {
  return !server_.isFinished() && server_.problem() == problem_;
}

void LocalizationBridge::takeTransform(const geometry_msgs::TransformStamped& transform) {
  if (!parameters_.pose_topic.empty()) return;
  try {
    const PublishedPose pose = publishedPose(transform);
    const bool is_of_body =
        pose.frame == parameters_.base_frame || pose.frame == parameters_.odom_frame;
    if (pose.parent == parameters_.map_frame && is_of_body) player_.take(pose);
  } catch (const InvalidProblem&) {
    return;  // tf warns of numbers that are no transform
  }
}

bool LocalizationBridge::run() {
  rivals_.refuse(tf_.rival());
  links_.sendStatic(stampNow(clock_));
  const auto is_due = [this] {
    return server_.isFinished() || (server_.problem() && server_.problem() != problem_);
  };
  while (waitFor(is_due, kForever) && !server_.isFinished()) serve();
  return server_.isFinished();
}

void LocalizationBridge::serve() {
  problem_ = server_.problem();
  if (!takeTarget() || !prepareNode()) return;
  rivals_.refuse(tf_.rival());
  rivals_.beginRun();
  keeper_.beginPlay();
  if (!server_.callReady()) {
    problem_.reset();  // try again: the server may be on its way
    pause(kPollPeriod);
    return;
  }
  if (!waitWhileCurrent([this] { return server_.source() != nullptr; }, "the scan")) return;
  scan_problem_.source = fromMessage(*server_.source());
  scan_problem_.time_limit = problem_->time_limit.toSec();
  player_.begin(scan_problem_);
  play();
  keeper_.endProblem(player_.isAnswered());
  letNodeFinish();
  player_.end();
}

bool LocalizationBridge::takeTarget() {
  if (!waitWhileCurrent([this] { return server_.target() != nullptr; }, "the map")) return false;
  const auto target = server_.target();
  const bool is_new = target->header.stamp != target_stamp_;
  keeper_.beginProblem(is_new);
  if (!is_new) return true;
  target_stamp_ = target->header.stamp;
  map_ = fromMessage(*target);
  is_map_due_ = true;
  return true;
}

bool LocalizationBridge::prepareNode() {
  if (is_map_due_ && parameters_.is_map_first) sendMap();
  if (!bringNode() || !findMounting()) return false;
  if (parameters_.is_map_first) settleMap();
  if (!callBeforeProblem()) return false;
  sendInitialPose();
  if (is_map_due_) sendMap();
  settleMap();
  return isCurrent();
}

void LocalizationBridge::sendMap() {
  inputs_.sendMap(map_, stampNow(clock_));
  is_map_due_ = false;
  generation_.reset();
}

/// Waits until the node is there, a new one where one is due; asks for a new one when none comes.
bool LocalizationBridge::bringNode() {
  const auto is_there = [this] { return keeper_.isThere() || !isCurrent(); };
  if (keeper_.needsRestart()) keeper_.restart();
  double start = steadyNow();
  while (!waitFor(is_there, std::min(kReminderPeriod, parameters_.start_limit))) {
    if (shutdown_.requested()) return false;
    std::cout << "waiting for a node that subscribes to "
              << node_.resolveName(parameters_.scan_topic) << std::endl;
    rivals_.refuse(tf_.rival());
    if (steadyNow() - start < parameters_.start_limit || parameters_.restart_after == 0) continue;
    std::cout << "there was none within " << parameters_.start_limit << " s (~start_limit)"
              << std::endl;
    keeper_.restart();
    start = steadyNow();
  }
  keeper_.beginWatch();
  return isCurrent();
}

/// Gives the node time for a map that it has not had before.
void LocalizationBridge::settleMap() {
  if (generation_ == keeper_.generation()) return;
  generation_ = keeper_.generation();
  pause(parameters_.map_settle);
}

/// E, which the bridge publishes as identity or somebody else publishes on tf.
bool LocalizationBridge::findMounting() {
  const auto& p = parameters_;
  if (p.scan_frame == p.base_frame || p.tf_base_scan != TfLink::kNone) return true;
  std::optional<Transform> found;
  const auto is_found = [&] {
    found = tf_.find(p.base_frame, p.scan_frame, ros::Time());
    return found.has_value();
  };
  if (!waitWhileCurrent(is_found, "tf from " + p.base_frame + " to " + p.scan_frame)) return false;
  scan_problem_.T_base_scan = *found;
  return true;
}

bool LocalizationBridge::callBeforeProblem() {
  if (parameters_.before_problem.empty()) return true;
  const auto is_called = [this] { return callEmptyOrTrigger(node_, parameters_.before_problem); };
  return waitWhileCurrent(is_called, "the service " + parameters_.before_problem);
}

bool LocalizationBridge::isOptical() const {
  using Optical = BridgeParameters::Optical;
  if (parameters_.optical != Optical::kAuto) return parameters_.optical == Optical::kYes;
  return problem_->data_set == "tum";
}

void LocalizationBridge::sendInitialPose() {
  std::optional<Transform> guess;
  if (problem_->has_guess != 0) guess = fromMessage(problem_->initial_guess);
  scan_problem_.T_scan_source = isOptical() ? uprightFromOptical(guess) : Transform::Identity();
  scan_problem_.initial_pose.reset();
  if (!guess || !parameters_.send_initialpose) return;
  if (pose_generation_ != keeper_.generation()) {  // subscriptions of a new node come one by one
    waitFor([this] { return inputs_.isInitialPoseTaken() || !isCurrent(); }, kInitialPoseLimit);
    pose_generation_ = keeper_.generation();
  }
  scan_problem_.initial_pose = bodyPose(*guess, scan_problem_.T_base_source());
  inputs_.sendInitialPose(*scan_problem_.initial_pose, stampNow(clock_));
  pause(parameters_.initialpose_settle);
}

void LocalizationBridge::play() {
  using Action = ScanSequence::Action;
  while (isCurrent() && !shutdown_.requested()) {
    const Action action = player_.step();
    if (action == Action::kSubmit || action == Action::kGiveUp) return submit(player_.decision());
    if (keeper_.hasLeft()) {
      Request request;
      request.status = Request::FAILED;
      request.solver_time = std::nan("");
      request.reason = kNodeLeft;
      return submit(request);
    }
    ros::getGlobalCallbackQueue()->callAvailable(
        ros::WallDuration(std::min(player_.patience(), kPollPeriod)));
  }
}

void LocalizationBridge::submit(Request request) {
  if (request.status == Request::TIMED_OUT && answers_ && !answers_->mistake().empty()) {
    request.reason += "; " + answers_->mistake();
  }
  request.problem_id = problem_->problem_id;
  request.pose.header = problem_->header;
  if (const auto usage = keeper_.usage()) {
    request.cpu_time = usage->cpu_time;
    request.peak_memory = usage->peak_memory;
  }
  server_.submit(request);
}

/// A scan that the node still works on would meet the next problem's initial pose, and its outcome
/// overwrite that.
void LocalizationBridge::letNodeFinish() {
  const bool will_be_new =
      keeper_.needsRestart() || parameters_.restart == BridgeParameters::Restart::kProblem;
  const auto is_finished = [&] {
    player_.takeWaiting();
    return will_be_new || keeper_.hasLeft() || server_.isFinished() ||
           player_.timeToFinish() <= 0.0;
  };
  if (waitFor(is_finished, parameters_.finish_limit) || shutdown_.requested()) return;
  std::cout << "the node under test may still be working on a scan of the last problem after "
            << parameters_.finish_limit
            << " s: the next one may start from that scan's pose (~finish_limit)" << std::endl;
}

}  // namespace pcrb
