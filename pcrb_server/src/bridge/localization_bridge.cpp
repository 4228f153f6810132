#include "bridge/localization_bridge.hpp"

#include <pcrb_msgs/Result.h>
#include <ros/callback_queue.h>

#include <algorithm>
#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/run/result.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/topics.hpp"
#include "ros/node_calls.hpp"
#include "ros/notices.hpp"

namespace pcrb {

namespace {

using Request = pcrb_msgs::SubmitPose::Request;

constexpr double kPollPeriod = 0.02;  // s
constexpr double kForever = 1e9;      // s
constexpr std::uint32_t kResultQueue = 1000;

}  // namespace

LocalizationBridge::ServedProblem::ServedProblem() = default;

LocalizationBridge::LocalizationBridge(const BridgeParameters& parameters,
                                       ShutdownRequest& shutdown)
    : parameters_(parameters),
      shutdown_(shutdown),
      inputs_(node_, parameters),
      tf_(node_, inputs_.ownedFrames(),
          [this](const geometry_msgs::TransformStamped& transform) { takeTransform(transform); }),
      monitor_(node_, parameters, inputs_),
      conflicts_(
          ros::this_node::getName(),
          {node_.resolveName(parameters.map_topic), node_.resolveName(parameters.scan_topic)},
          node_.resolveName(parameters.initialpose_topic),
          [this](const std::string& node) { return inputs_.isObserver(node); }),
      server_(nullptr) {
  results_ = node_.subscribe<pcrb_msgs::Result>(
      topics::kResult, kResultQueue, [this](const pcrb_msgs::ResultConstPtr& result) {
        if (result->outcome != pcrb_msgs::Result::REPLIED) return;
        misalignment_.add(result->error, result->initial_misalignment);
      });
  if (parameters.pose_topic.empty()) return;
  answers_.emplace(
      node_, parameters.pose_topic,
      [this](const PublishedPose& pose) {
        if (served_ && served_->scans) served_->scans->take(pose);
      },
      [this](AnswerFault fault, const std::string& text) {
        if (served_ && served_->scans) served_->scans->note(fault, text);
      });
}

bool LocalizationBridge::run() {
  refuseConflicts();
  inputs_.sendStaticLinks();
  while (!shutdown_.requested() && !server_.isFinished()) step();
  printDiagnosis();
  return server_.isFinished();
}

void LocalizationBridge::step() {
  switch (step_) {
    case Step::kWaitForMap:
      step_ = waitForMap();
      break;
    case Step::kWaitForNode:
      step_ = waitForNode();
      break;
    case Step::kSettle:
      step_ = settle();
      break;
    case Step::kPlay:
      step_ = play();
      break;
    case Step::kDrain:
      step_ = drainNode();
      break;
  }
}

LocalizationBridge::Step LocalizationBridge::waitForMap() {
  served_.reset();
  const auto is_due = [this] {
    return server_.isFinished() || (server_.problem() && server_.problem() != newest_);
  };
  if (!waitFor(is_due, kForever) || server_.isFinished()) return Step::kWaitForMap;
  newest_ = server_.problem();
  served_.emplace();
  served_->message = newest_;
  const auto is_there = [this] { return server_.target() != nullptr; };
  if (!waitWhileCurrent(is_there, "the map")) return Step::kWaitForMap;
  served_->target = server_.target();
  monitor_.beginProblem(isMapDue());
  return Step::kWaitForNode;
}

LocalizationBridge::Step LocalizationBridge::waitForNode() {
  if (isMapDue() && parameters_.is_map_first) sendMap();
  return bringUpNode() && findMounting() ? Step::kSettle : Step::kWaitForMap;
}

LocalizationBridge::Step LocalizationBridge::settle() {
  if (parameters_.is_map_first) settleMap();
  if (!callBeforeProblem()) return Step::kWaitForMap;
  sendInitialPose();
  if (isMapDue()) sendMap();
  settleMap();
  if (!isCurrent()) return Step::kWaitForMap;
  refuseConflicts();
  checkTopics();
  conflicts_.beginRun();
  monitor_.beginPlay();
  if (!server_.callReady()) {
    newest_.reset();  // try again: the server may be on its way
    pause(kPollPeriod);
    return Step::kWaitForMap;
  }
  const auto is_there = [this] { return server_.source() != nullptr; };
  return waitWhileCurrent(is_there, "the scan") ? Step::kPlay : Step::kWaitForMap;
}

LocalizationBridge::Step LocalizationBridge::play() {
  using Action = ScanSchedule::Action;
  ScanPublisher& scans = served_->scans.emplace(
      parameters_, inputs_, tf_,
      LocalizationProblem{served_->message->time_limit.toSec(), fromMessage(*server_.source()),
                          served_->mounting, initialPose()},
      response_time_);
  while (isCurrent() && !shutdown_.requested()) {
    const Action action = scans.step();
    callAfterFirstScan();
    if (action == Action::kSubmit || action == Action::kGiveUp) {
      submit(scans.decision());
      break;
    }
    if (monitor_.hasLeft()) {
      Request request;
      request.status = Request::FAILED;
      request.solver_time = std::nan("");
      request.reason = kNodeLeft;
      submit(request);
      break;
    }
    ros::getGlobalCallbackQueue()->callAvailable(
        ros::WallDuration(std::min(scans.timeToNext(), kPollPeriod)));
  }
  inputs_.stop();
  monitor_.endProblem(scans.isAnswered());
  return Step::kDrain;
}

/// A scan that the node still works on would meet the next problem's initial pose, and its outcome
/// overwrite that.
LocalizationBridge::Step LocalizationBridge::drainNode() {
  ScanPublisher& scans = *served_->scans;
  const bool will_be_new =
      monitor_.needsRestart() || parameters_.restart == BridgeParameters::Restart::kProblem;
  const auto is_finished = [&] {
    scans.takeWaiting();
    return will_be_new || monitor_.hasLeft() || server_.isFinished() || scans.timeToFinish() <= 0.0;
  };
  if (!waitFor(is_finished, parameters_.finish_limit) && !shutdown_.requested()) {
    tellPeople("the node under test may still be working on a scan of the last problem after " +
               formatShortest(parameters_.finish_limit) +
               " s: the next one may start from that scan's pose (finish_limit)");
  }
  response_time_ = scans.responseTime();
  return Step::kWaitForMap;
}

bool LocalizationBridge::isCurrent() const {
  return !server_.isFinished() && served_ && server_.problem() == served_->message;
}

void LocalizationBridge::refuseConflicts() {
  std::vector<std::string> conflicts = conflicts_.find(publishersByTopic());
  if (!tf_.conflict().empty()) conflicts.push_back(tf_.conflict());
  if (conflicts.empty()) return;
  std::string message = "another node does what the bridge does: start the localizer alone";
  for (const auto& conflict : conflicts) message += "\n  " + conflict;
  throw Error(message);
}

void LocalizationBridge::takeTransform(const geometry_msgs::TransformStamped& transform) {
  if (!parameters_.pose_topic.empty() || !served_ || !served_->scans) return;
  try {
    const PublishedPose pose = publishedPose(transform);
    const bool is_of_body =
        pose.frame == parameters_.base_frame || pose.frame == parameters_.odom_frame;
    if (pose.parent == parameters_.map_frame && is_of_body) served_->scans->take(pose);
  } catch (const InvalidProblem& error) {
    served_->scans->note(AnswerFault::kInvalid, std::string("tf: ") + error.what());
  }
}

/// @param cpu_time  s that the node used for the problem; negative: unknown.
NoAnswerCause LocalizationBridge::causeOfNoAnswer(double cpu_time) const {
  const ScanPublisher& scans = *served_->scans;
  const AnswerDiagnosis faults = scans.faults();
  const int count = scans.scansSent();
  const std::string given = std::to_string(count) + (count == 1 ? " scan" : " scans");
  if (scans.hasOnlyEchoed()) {
    const std::string echo = "the node said nothing but the initial pose, once, to " + given;
    return {"echo", echo + (faults.isEmpty() ? "" : "; " + faults.cause().text)};
  }
  if (!faults.isEmpty()) return faults.cause();
  Silence silence;
  silence.elapsed = scans.elapsed();
  silence.cpu_time = cpu_time;
  if (answers_ && !answers_->isPublished()) {
    silence.is_published = false;
    silence.pose_topic = node_.resolveName(parameters_.pose_topic);
    silence.other_topics = publishedPoseTopics(node_.resolveName(topics::kInitialPose));
  }
  return causeOf(silence, given);
}

void LocalizationBridge::printDiagnosis() const {
  for (const auto& text : {failures_.table(), misalignment_.warning()}) {
    if (!text.empty()) tellPeople(text);
  }
}

/// Some nodes locate the last scan that they have, on request: that is of this problem only now.
void LocalizationBridge::callAfterFirstScan() {
  const ScanPublisher& scans = *served_->scans;
  if (served_->was_called || parameters_.after_first_scan.empty()) return;
  const bool is_processed =
      scans.isAnswered() ||
      (scans.scansSent() > 0 && scans.elapsed() >= parameters_.first_scan_settle);
  if (!is_processed) return;
  served_->was_called = true;
  if (callEmptyOrTrigger(node_, parameters_.after_first_scan)) return;
  tellPeople("the service " + parameters_.after_first_scan + " (after_first_scan) failed");
}

/// Whatever is wrong from the start is refused before a problem counts: a run without a result may
/// go on with other parameters.
void LocalizationBridge::refuseWrongSetup(const Request& request) {
  if (was_answered_) return;
  pause(kPollPeriod);  // for transforms that are on their way beside the answer
  refuseConflicts();
  was_answered_ = served_->scans->isAnswered();
  const bool is_mute = request.status == Request::TIMED_OUT && answers_ && !answers_->isPublished();
  if (!is_mute || was_answered_) return;
  const auto others = publishedPoseTopics(node_.resolveName(topics::kInitialPose));
  throw Error(adviceOnTopic(causeOfNoAnswer(-1.0), others));
}

void LocalizationBridge::submit(Request request) {
  refuseWrongSetup(request);
  request.problem_id = served_->message->problem_id;
  request.pose.header = served_->message->header;
  const auto usage = monitor_.usage();
  if (usage) {
    request.cpu_time = usage->cpu_time;
    request.peak_memory = usage->peak_memory;
  }
  if (request.status == Request::TIMED_OUT) {
    const NoAnswerCause cause = causeOfNoAnswer(usage ? usage->cpu_time : -1.0);
    request.reason = cause.code + ": " + cause.text;
    const std::string message = failures_.note(cause);
    if (!message.empty()) tellPeople(message);
  }
  server_.submit(request);
}

}  // namespace pcrb
