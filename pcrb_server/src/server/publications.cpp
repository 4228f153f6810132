#include "server/publications.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <pcrb_msgs/Problem.h>
#include <pcrb_msgs/Result.h>
#include <pcrb_msgs/Summary.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <sstream>

#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/topics.hpp"

namespace pcrb {

namespace {

/// Nodes that people look with; they are not clients.
bool isObserver(const std::string& node) {
  const std::string name = node.substr(node.rfind('/') + 1);
  for (const char* prefix : {"rviz", "rosbag", "rostopic", "rosout"}) {
    if (name.rfind(prefix, 0) == 0) return true;
  }
  for (const std::string prefix : {"record_", "play_"}) {  // rosbag's, which end with a time
    const bool is_bag = name.rfind(prefix, 0) == 0 && name.size() > prefix.size() &&
                        name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
    if (is_bag) return true;
  }
  return false;
}

std::uint8_t kindNumber(Kind kind) {
  return kind == Kind::kLocal ? pcrb_msgs::Problem::LOCAL : pcrb_msgs::Problem::GLOBAL;
}

/// Where people look, wherever the local origin is: the middle of the target's bounding box, in
/// whole metres. Not its centroid, which is the secret pose of a scan without a viewpoint when the
/// same cloud is another problem's source.
Eigen::Vector3d middleOf(const PointCloud& target) {
  Eigen::AlignedBox3f box;
  for (const auto& point : target.points) box.extend(point);
  return box.center().cast<double>().array().round();
}

template <typename Message>
Message withHeader(const std::string& frame, const ros::Time& stamp) {
  Message message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  return message;
}

std_msgs::Header header(const std::string& frame, const ros::Time& stamp) {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = stamp;
  return header;
}

visualization_msgs::Marker errorText(const std_msgs::Header& header,
                                     const Eigen::Vector3d& position, const Result& result) {
  std::ostringstream text;
  text.precision(3);
  text << "error " << result.error << " (initial " << result.initial_misalignment << ")";
  if (result.outcome != Outcome::kReplied) text << '\n' << toString(result.outcome);
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = "error";
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.pose.position.x = position.x();
  marker.pose.position.y = position.y();
  marker.pose.position.z = position.z() + 2.0;
  marker.pose.orientation.w = 1.0;
  marker.scale.z = 1.0;
  marker.color.r = marker.color.g = marker.color.b = marker.color.a = 1.0f;
  marker.text = text.str();
  return marker;
}

}  // namespace

Publications::Publications(ros::NodeHandle& node, const ServerParameters& parameters)
    : parameters_(parameters) {
  const auto joined = [this](const ros::SingleSubscriberPublisher& subscriber) {
    const std::lock_guard<std::mutex> lock(mutex_);
    listeners_.insert(subscriber.getSubscriberName());
  };
  const auto left = [this](const ros::SingleSubscriberPublisher& subscriber) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = listeners_.find(subscriber.getSubscriberName());
    if (found != listeners_.end()) listeners_.erase(found);
  };
  target_ = node.advertise<sensor_msgs::PointCloud2>(topics::kTarget, 1, true);
  source_ = node.advertise<sensor_msgs::PointCloud2>(topics::kSource, 1, true);
  problem_ =
      node.advertise<pcrb_msgs::Problem>(topics::kProblem, 1, joined, left, ros::VoidPtr(), true);
  initial_pose_ = node.advertise<geometry_msgs::PoseWithCovarianceStamped>(topics::kInitialPose, 1);
  result_ = node.advertise<pcrb_msgs::Result>(topics::kResult, 100);
  summary_ = node.advertise<pcrb_msgs::Summary>(topics::kSummary, 1, true);
  source_aligned_ = node.advertise<sensor_msgs::PointCloud2>(topics::kSourceAligned, 1);
  markers_ = node.advertise<visualization_msgs::MarkerArray>(topics::kMarkers, 1);
  if (!parameters.debug) return;
  truth_ = node.advertise<geometry_msgs::PoseStamped>(topics::kDebugTruth, 10);
  perturbation_ = node.advertise<geometry_msgs::PoseStamped>(topics::kDebugPerturbation, 10);
}

std::set<std::string> Publications::listeners() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::set<std::string> names;
  for (const auto& name : listeners_) {
    if (!isObserver(name)) names.insert(name);
  }
  return names;
}

bool Publications::hasGuess(const PreparedProblem& prepared) const {
  return prepared.planned->key.kind == Kind::kLocal || parameters_.global_guess;
}

void Publications::announceTarget(const PreparedProblem& prepared,
                                  const Announcement& announcement) {
  const Eigen::Vector3d& origin = prepared.target->cloud.local_origin;
  is_earth_known_ |= !origin.isZero();
  if (is_earth_known_) {
    broadcast("earth", parameters_.map_frame, Transform(Eigen::Translation3d(origin)),
              announcement.stamp, true);
  }
  broadcast(parameters_.map_frame, "pcrb_target",
            Transform(Eigen::Translation3d(middleOf(prepared.target->cloud))), announcement.stamp,
            true);
  target_stamp_ = announcement.stamp;
  SerializedCloud target = prepared.target_message;
  target.setStamp(announcement.stamp);
  target_.publish(target);
}

void Publications::announce(const PreparedProblem& prepared, const Announcement& announcement) {
  if (prepared.publishes_target) announceTarget(prepared, announcement);
  auto problem = withHeader<pcrb_msgs::Problem>(parameters_.map_frame, announcement.stamp);
  problem.problem_id = announcement.problem_id;
  problem.data_set = prepared.planned->key.data_set;
  problem.kind = kindNumber(prepared.planned->key.kind);
  problem.presentation =
      static_cast<std::uint8_t>(parameters_.isLocalization() ? pcrb_msgs::Problem::LOCALIZATION
                                                             : pcrb_msgs::Problem::REGISTRATION);
  problem.index = announcement.index;
  problem.count = announcement.count;
  problem.target_stamp = target_stamp_;
  problem.source_frame = parameters_.sourceFrame();
  problem.has_guess = hasGuess(prepared) ? 1 : 0;
  problem.initial_guess =
      toMessage(hasGuess(prepared) ? prepared.presentation.guess : Transform::Identity());
  problem.time_limit = ros::Duration(parameters_.time_limit);
  problem_.publish(problem);
}

void Publications::handOut(const PreparedProblem& prepared, const Announcement& announcement) {
  if (hasGuess(prepared)) {
    auto pose = withHeader<geometry_msgs::PoseWithCovarianceStamped>(parameters_.map_frame,
                                                                     announcement.stamp);
    pose.pose.pose = toMessage(prepared.presentation.guess);
    initial_pose_.publish(pose);
  }
  SerializedCloud source = prepared.source_message;
  source.setStamp(announcement.stamp);
  source_.publish(source);
  if (parameters_.debug) showTruth(prepared, announcement);
}

void Publications::showTruth(const PreparedProblem& prepared, const Announcement& announcement) {
  auto pose = withHeader<geometry_msgs::PoseStamped>(parameters_.map_frame, announcement.stamp);
  pose.pose = toMessage(prepared.presentation.applied.inverse());
  truth_.publish(pose);
  pose.pose = toMessage(prepared.P);
  perturbation_.publish(pose);
}

void Publications::finish(const PreparedProblem& prepared, const Announcement& announcement,
                          const Result& result) {
  auto message = withHeader<pcrb_msgs::Result>(parameters_.map_frame, announcement.stamp);
  message.problem_id = announcement.problem_id;
  message.data_set = result.key.data_set;
  message.kind = kindNumber(result.key.kind);
  message.index = announcement.index;
  message.count = announcement.count;
  message.outcome = static_cast<std::uint8_t>(result.outcome);
  message.error = result.error;
  message.initial_misalignment = result.initial_misalignment;
  message.rotation_error = result.rotation_error;
  message.translation_error = result.translation_error;
  message.runtime = result.runtime.value_or(std::nan(""));
  message.reason = result.reason;
  result_.publish(message);
  showReply(prepared, announcement, result);
}

void Publications::showReply(const PreparedProblem& prepared, const Announcement& announcement,
                             const Result& result) {
  const std_msgs::Header in_map = header(parameters_.map_frame, announcement.stamp);
  const Transform reply = result.position && result.orientation
                              ? makeTransform(*result.position, *result.orientation)
                              : prepared.presentation.guess;
  broadcast(parameters_.map_frame, "pcrb_reply", reply, announcement.stamp, false);
  const Transform T_map_source = prepared.presentation.residual(reply);
  if (source_aligned_.getNumSubscribers() > 0) {
    source_aligned_.publish(toMessage(prepared.source->cloud, T_map_source, in_map));
  }
  if (markers_.getNumSubscribers() > 0) {
    visualization_msgs::MarkerArray markers;
    markers.markers.push_back(
        errorText(in_map, T_map_source * prepared.source->metric->centroid(), result));
    markers_.publish(markers);
  }
}

void Publications::broadcast(const std::string& parent, const std::string& child,
                             const Transform& T, const ros::Time& stamp, bool is_static) {
  if (!parameters_.publish_tf) return;
  auto transform = withHeader<geometry_msgs::TransformStamped>(parent, stamp);
  transform.child_frame_id = child;
  const geometry_msgs::Pose pose = toMessage(T);
  transform.transform.translation.x = pose.position.x;
  transform.transform.translation.y = pose.position.y;
  transform.transform.translation.z = pose.position.z;
  transform.transform.rotation = pose.orientation;
  if (is_static) {
    static_tf_.sendTransform(transform);
  } else {
    tf_.sendTransform(transform);
  }
}

void Publications::summary(const std::vector<SequenceSummary>& summaries, bool finished) {
  auto message = withHeader<pcrb_msgs::Summary>("", ros::Time::now());
  message.finished = finished ? 1 : 0;
  for (const auto& summary : summaries) {
    pcrb_msgs::SequenceSummary row;
    row.name = summary.name;
    row.kind = summary.kind;
    row.count = static_cast<std::uint32_t>(summary.error.count);
    row.replied = static_cast<std::uint32_t>(summary.outcomes[0]);
    row.failed = static_cast<std::uint32_t>(summary.outcomes[1]);
    row.timed_out = static_cast<std::uint32_t>(summary.outcomes[2]);
    row.rejected = static_cast<std::uint32_t>(summary.outcomes[3]);
    row.skipped = static_cast<std::uint32_t>(summary.outcomes[4]);
    row.median = summary.error.median;
    row.q75 = summary.error.q75;
    row.q95 = summary.error.q95;
    row.mean = summary.error.mean;
    row.stddev = summary.error.stddev;
    message.sequences.push_back(row);
  }
  summary_.publish(message);
}

}  // namespace pcrb
