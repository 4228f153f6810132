#include "bridge/answer_source.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "ros/topic_peers.hpp"

namespace pcrb {

namespace {

constexpr std::uint32_t kQueue = 100;

PublishedPose withHeader(const std_msgs::Header& header) {
  PublishedPose pose;
  pose.stamp = header.stamp;
  pose.parent = withoutSlash(header.frame_id);
  return pose;
}

PublishedPose read(const geometry_msgs::PoseStamped& message) {
  PublishedPose pose = withHeader(message.header);
  pose.T_parent_frame = fromMessage(message.pose);
  return pose;
}

PublishedPose read(const geometry_msgs::PoseWithCovarianceStamped& message) {
  PublishedPose pose = withHeader(message.header);
  pose.T_parent_frame = fromMessage(message.pose.pose);
  pose.covariance = covarianceOf(message.pose);
  return pose;
}

PublishedPose read(const nav_msgs::Odometry& message) {
  PublishedPose pose = withHeader(message.header);
  pose.frame = withoutSlash(message.child_frame_id);
  pose.T_parent_frame = fromMessage(message.pose.pose);
  pose.covariance = covarianceOf(message.pose);
  return pose;
}

PublishedPose read(const geometry_msgs::TransformStamped& message) {
  return publishedPose(message);
}

/// @return  nothing if the message is of another type.
template <typename Message>
std::optional<PublishedPose> readAs(const topic_tools::ShapeShifter& message) {
  if (message.getDataType() != ros::message_traits::DataType<Message>::value()) return std::nullopt;
  return read(*message.instantiate<Message>());
}

std::optional<PublishedPose> readAny(const topic_tools::ShapeShifter& message) {
  if (auto pose = readAs<geometry_msgs::PoseStamped>(message)) return pose;
  if (auto pose = readAs<geometry_msgs::PoseWithCovarianceStamped>(message)) return pose;
  if (auto pose = readAs<nav_msgs::Odometry>(message)) return pose;
  return readAs<geometry_msgs::TransformStamped>(message);
}

}  // namespace

PublishedPose publishedPose(const geometry_msgs::TransformStamped& message) {
  PublishedPose pose = withHeader(message.header);
  pose.frame = withoutSlash(message.child_frame_id);
  pose.T_parent_frame = fromMessage(message.transform);
  return pose;
}

AnswerSource::AnswerSource(ros::NodeHandle& node, const std::string& topic, Listener listener,
                           FaultListener faults)
    : topic_(topic), listener_(std::move(listener)), faults_(std::move(faults)) {
  using Message = topic_tools::ShapeShifter;
  subscriber_ = node.subscribe<Message>(
      topic, kQueue, [this](const Message::ConstPtr& message) { take(message); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

void AnswerSource::take(const topic_tools::ShapeShifter::ConstPtr& message) {
  std::optional<PublishedPose> pose;
  try {
    pose = readAny(*message);
  } catch (const InvalidProblem& error) {
    return faults_(AnswerFault::kInvalid, topic_ + ": " + error.what());
  }
  if (!pose) {
    return faults_(
        AnswerFault::kType,
        topic_ + ": found messages of type " + message->getDataType() +
            ", expected PoseStamped, PoseWithCovarianceStamped, TransformStamped or Odometry");
  }
  listener_(*pose);
}

bool isPoseType(const std::string& type) {
  static const std::set<std::string> kPoseTypes{
      "geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped",
      "geometry_msgs/TransformStamped", "nav_msgs/Odometry"};
  return kPoseTypes.count(type) > 0;
}

std::vector<PoseTopic> publishedPoseTopics(const std::string& excluded) {
  ros::master::V_TopicInfo topics;
  if (!ros::master::getTopics(topics)) return {};
  const PublishersByTopic publishers = publishersByTopic();
  std::vector<PoseTopic> found;
  for (const auto& topic : topics) {
    if (!isPoseType(topic.datatype) || topic.name == excluded) continue;
    std::string nodes;
    const auto [first, last] = publishers.equal_range(topic.name);
    for (auto node = first; node != last; ++node) {
      if (node->second == ros::this_node::getName()) continue;
      nodes += (nodes.empty() ? "" : " ") + node->second;
    }
    if (!nodes.empty()) found.push_back({topic.name, topic.datatype, nodes});
  }
  return found;
}

}  // namespace pcrb
