#include <ros/callback_queue.h>

#include <algorithm>

#include "bridge/localization_bridge.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/topics.hpp"
#include "ros/node_calls.hpp"

/// The bridge's work before it plays scans: node, map, mounting of the sensor, initial pose; and
/// its waits.
namespace pcrb {

namespace {

constexpr double kWaitPeriod = 0.02;       // s
constexpr double kReminderPeriod = 5.0;    // s
constexpr double kInitialPoseLimit = 5.0;  // s for a new node to subscribe to the initial pose

}  // namespace

/// Works off callbacks until the condition holds, for at most `limit` s; false if it does not by
/// then, or the bridge shuts down.
bool LocalizationBridge::waitFor(const Condition& condition, double limit) {
  const double end = steadyNow() + limit;
  while (!shutdown_.requested() && !condition()) {
    const double rest = end - steadyNow();
    if (rest <= 0.0) return false;
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(std::min(rest, kWaitPeriod)));
  }
  return !shutdown_.requested();
}

/// Waits as long as the problem is the newest one, and tells people what for.
bool LocalizationBridge::waitWhileCurrent(const Condition& condition, const Description& what) {
  const auto is_over = [&] { return condition() || !isCurrent(); };
  Notice notice;
  while (!waitFor(is_over, kReminderPeriod)) {
    if (shutdown_.requested()) return false;
    notice.tell("waiting for " + what());
    refuseConflicts();
  }
  return isCurrent();
}

bool LocalizationBridge::waitWhileCurrent(const Condition& condition, const std::string& what) {
  return waitWhileCurrent(condition, [&what] { return what; });
}

/// What this node publishes is among them, so that nobody is said to wait for it.
TopicGraph LocalizationBridge::topicsOfOthers() const {
  TopicGraph graph{topicTypes(), publishersByTopic(), subscribersByTopic()};
  for (auto* nodes : {&graph.publishers, &graph.subscribers}) {
    for (auto entry = nodes->begin(); entry != nodes->end();) {
      const std::string& name = entry->second;
      const bool is_sent_here = nodes == &graph.publishers && name == ros::this_node::getName();
      const bool is_other = name != ros::this_node::getName() && !inputs_.isObserver(name);
      entry = is_other || is_sent_here ? std::next(entry) : nodes->erase(entry);
    }
  }
  return graph;
}

/// Tells of topics that may be others than those of the node under test, as long as it has not
/// answered.
/// @throws Error  if what is published on ~pose_topic is no pose.
void LocalizationBridge::checkTopics() {
  if (was_answered_) return;
  const TopicGraph graph = topicsOfOthers();
  untaken_.tell(describeUntaken(inputs_.untaken(), graph));
  if (!answers_) return;
  const std::string topic = node_.resolveName(parameters_.pose_topic);
  const auto others = publishedPoseTopics(node_.resolveName(topics::kInitialPose));
  if (graph.publishers.count(topic) == 0) return silent_.tell(describeSilence(topic, others));
  const auto known = graph.types.find(topic);
  const std::string type = known == graph.types.end() ? "*" : known->second;
  if (type == "*" || isPoseType(type)) return;
  throw Error(describeWrongType(topic, type, others));
}

void LocalizationBridge::pause(double seconds) {
  waitFor(
      [this] {
        inputs_.sendMotion();
        return false;
      },
      seconds);
}

void LocalizationBridge::sendMap() {
  inputs_.sendMap(fromMessage(*served_->target));
  published_map_ = served_->target->header.stamp;
}

/// Waits until the node is there, a new one where one is due; asks for a new one when none comes.
bool LocalizationBridge::bringUpNode() {
  const auto is_there = [this] { return monitor_.isThere() || !isCurrent(); };
  if (monitor_.needsRestart()) monitor_.restart();
  double start = steadyNow();
  Notice notice;
  while (!waitFor(is_there, std::min(kReminderPeriod, parameters_.start_limit))) {
    if (shutdown_.requested()) return false;
    notice.tell(describeWait(node_.resolveName(parameters_.scan_topic), inputs_.untaken(),
                             topicsOfOthers()));
    refuseConflicts();
    if (steadyNow() - start < parameters_.start_limit || parameters_.restart_after == 0) continue;
    tellPeople("there was none within " + formatShortest(parameters_.start_limit) +
               " s (start_limit): it is started anew");
    monitor_.restart();
    start = steadyNow();
  }
  monitor_.beginWatch();
  return isCurrent();
}

LocalizationBridge::NodeHistory& LocalizationBridge::history() {
  const int restart_count = monitor_.restartCount();
  if (history_.restart_count != restart_count) history_ = {restart_count, std::nullopt, false};
  return history_;
}

/// Gives the node time for a map that it has not had before.
void LocalizationBridge::settleMap() {
  const ros::Time stamp = served_->target->header.stamp;
  if (history().settled_map == stamp) return;
  history().settled_map = stamp;
  pause(parameters_.map_settle);
}

/// E, which the bridge publishes as identity or another node publishes on tf.
bool LocalizationBridge::findMounting() {
  const auto& p = parameters_;
  const auto& message = *served_->message;
  if (message.has_guess != 0) served_->guess = fromMessage(message.initial_guess);
  if (isOptical()) served_->mounting.T_scan_source = uprightFromOptical(served_->guess);
  if (p.scan_frame == p.base_frame || p.tf_base_scan != TfLink::kNone) return true;
  std::optional<Transform> found;
  const auto is_found = [&] {
    found = tf_.find(p.base_frame, p.scan_frame, ros::Time());
    return found.has_value();
  };
  const auto what = [&] {
    return "tf from " + p.base_frame + " to " + p.scan_frame + "; " +
           adviceOnMounting(p.base_frame, p.scan_frame, tf_.frames());
  };
  if (!waitWhileCurrent(is_found, Description(what))) return false;
  served_->mounting.T_base_scan = *found;
  return true;
}

bool LocalizationBridge::callBeforeProblem() {
  if (parameters_.before_problem.empty()) return true;
  const auto is_called = [this] { return callEmptyOrTrigger(node_, parameters_.before_problem); };
  return waitWhileCurrent(is_called,
                          "the service " + parameters_.before_problem + " (before_problem)");
}

bool LocalizationBridge::isOptical() const {
  using Optical = BridgeParameters::Optical;
  if (parameters_.optical != Optical::kAuto) return parameters_.optical == Optical::kYes;
  return served_->message->data_set == "tum";
}

/// T_map_base that the node is sent, if it is.
std::optional<Transform> LocalizationBridge::initialPose() const {
  if (!served_->guess || !parameters_.send_initialpose) return std::nullopt;
  return bodyPose(*served_->guess, served_->mounting.T_base_source());
}

void LocalizationBridge::sendInitialPose() {
  const auto pose = initialPose();
  if (!pose) return;
  if (!history().was_waited_for_subscription) {  // subscriptions of a new node come one by one
    waitFor([this] { return inputs_.isInitialPoseTaken() || !isCurrent(); }, kInitialPoseLimit);
    history().was_waited_for_subscription = true;
    monitor_.extendWatch();
  }
  pause(inputs_.timeToStop());
  const bool is_local = served_->message->kind == pcrb_msgs::Problem::LOCAL;
  if (is_local && !parameters_.imu_topic.empty()) tilted_.tell(warningOfTilt(*pose));
  inputs_.sendInitialPose(*pose);
  pause(parameters_.initialpose_settle);
}

}  // namespace pcrb
