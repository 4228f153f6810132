#include "archives/pose_messages.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {
namespace {

PoseMessage makePoseMessage(const geometry_msgs::PoseStamped& stamped) {
  PoseMessage message{stamped.header, {}, {}};
  message.pose.pose = stamped.pose;
  return message;
}

PoseMessage makePoseMessage(const geometry_msgs::TransformStamped& stamped) {
  PoseMessage message{stamped.header, stamped.child_frame_id, {}};
  const auto& t = stamped.transform.translation;
  message.pose.pose.position.x = t.x;
  message.pose.pose.position.y = t.y;
  message.pose.pose.position.z = t.z;
  message.pose.pose.orientation = stamped.transform.rotation;
  return message;
}

std::vector<PoseMessage> makePoseMessages(const nav_msgs::Path& path) {
  std::vector<PoseMessage> poses;
  for (const auto& stamped : path.poses) {
    poses.push_back(makePoseMessage(stamped));
    if (stamped.header.frame_id.empty()) poses.back().header.frame_id = path.header.frame_id;
  }
  return poses;
}

std::string placeOf(const std::string& topic, const std_msgs::Header& header) {
  return topic + " at " + pcrb::formatStamp(pcrb::stampOf(header.stamp));
}

void requireSameFrame(const std::string& place, const std::string& found,
                      const std::string& expected) {
  if (found == expected) return;
  throw pcrb::InvalidFile(place, 0, "a pose in the frame `" + found + "`",
                          "`" + expected + "`, as those before it");
}

}  // namespace

const char* const kPoseTypes =
    "geometry_msgs PoseStamped, PoseWithCovarianceStamped or TransformStamped, or nav_msgs "
    "Odometry or Path";

bool isPoseType(const std::string& type) {
  constexpr std::array<std::string_view, 5> kTypes = {
      "geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped",
      "geometry_msgs/TransformStamped", "nav_msgs/Odometry", "nav_msgs/Path"};
  return std::count(kTypes.begin(), kTypes.end(), type) > 0;
}

std::vector<PoseMessage> posesOf(const rosbag::MessageInstance& message) {
  if (const auto stamped = messageIf<geometry_msgs::PoseStamped>(message)) {
    return {makePoseMessage(*stamped)};
  }
  if (const auto stamped = messageIf<geometry_msgs::PoseWithCovarianceStamped>(message)) {
    return {{stamped->header, {}, stamped->pose}};
  }
  if (const auto odometry = messageIf<nav_msgs::Odometry>(message)) {
    return {{odometry->header, odometry->child_frame_id, odometry->pose}};
  }
  if (const auto stamped = messageIf<geometry_msgs::TransformStamped>(message)) {
    return {makePoseMessage(*stamped)};
  }
  if (const auto path = messageIf<nav_msgs::Path>(message)) return makePoseMessages(*path);
  throw pcrb::InvalidFile(message.getTopic(), 0, message.getDataType(), kPoseTypes);
}

pcrb::Transform transformOf(const PoseMessage& message, const std::string& place) {
  try {
    return pcrb::fromMessage(message.pose.pose);
  } catch (const pcrb::InvalidProblem& error) {
    throw pcrb::InvalidFile(place, error.what());
  }
}

BagTrajectory readBagTrajectory(const BagMessages& bags, const std::string& topic) {
  std::vector<pcrb::StampedPose> poses;
  std::string world;
  std::string body;
  bags.forEach({topic}, [&](const rosbag::MessageInstance& instance) {
    for (const PoseMessage& message : posesOf(instance)) {
      const std::string place = placeOf(topic, message.header);
      if (poses.empty()) {
        world = pcrb::withoutSlash(message.header.frame_id);
        body = pcrb::withoutSlash(message.child_frame);
      }
      requireSameFrame(place, pcrb::withoutSlash(message.header.frame_id), world);
      poses.push_back({pcrb::stampOf(message.header.stamp), transformOf(message, place)});
    }
  });
  if (poses.empty()) {
    throw pcrb::InvalidFile("topic " + topic, 0, "no message among " + bags.describeTopics(),
                            kPoseTypes);
  }
  return {pcrb::Trajectory(std::move(poses)), world, body};
}

}  // namespace pcrb_tools
