#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "archives/bag_messages.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "scoring/recorded_poses.hpp"

namespace pcrb_tools {
namespace {

using Request = pcrb_msgs::SubmitPose::Request;

Request makeRequest(const std_msgs::Header& header, const geometry_msgs::Pose& pose) {
  Request request;
  request.status = Request::POSE;
  request.solver_time = std::nan("");
  request.pose.header = header;
  request.pose.pose = pose;
  return request;
}

Request makeRequest(const std_msgs::Header& header,
                    const geometry_msgs::PoseWithCovariance& estimate) {
  Request request = makeRequest(header, estimate.pose);
  if (const auto covariance = pcrb::covarianceOf(estimate)) {
    request.has_covariance = 1;
    std::copy(covariance->begin(), covariance->end(), request.covariance.begin());
  }
  return request;
}

geometry_msgs::Pose poseOf(const geometry_msgs::Transform& transform) {
  geometry_msgs::Pose pose;
  pose.position.x = transform.translation.x;
  pose.position.y = transform.translation.y;
  pose.position.z = transform.translation.z;
  pose.orientation = transform.rotation;
  return pose;
}

/// Whatever type it is of.
Request makeRequest(const rosbag::MessageInstance& message) {
  if (const auto pose = message.instantiate<geometry_msgs::PoseStamped>()) {
    return makeRequest(pose->header, pose->pose);
  }
  if (const auto pose = message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()) {
    return makeRequest(pose->header, pose->pose);
  }
  if (const auto odometry = message.instantiate<nav_msgs::Odometry>()) {
    return makeRequest(odometry->header, odometry->pose);
  }
  if (const auto transform = message.instantiate<geometry_msgs::TransformStamped>()) {
    return makeRequest(transform->header, poseOf(transform->transform));
  }
  throw pcrb::InvalidFile(message.getTopic(), 0, message.getDataType(),
                          "geometry_msgs PoseStamped, PoseWithCovarianceStamped or "
                          "TransformStamped, or nav_msgs/Odometry");
}

}  // namespace

std::vector<RecordedPose> readBagPoses(const std::string& path, const std::string& topic,
                                       const std::string& frame) {
  const BagMessages bag({path});
  std::vector<RecordedPose> poses;
  bag.forEach({topic}, [&](const rosbag::MessageInstance& message) {
    RecordedPose pose;
    pose.reply.request = makeRequest(message);
    const std_msgs::Header& header = pose.reply.request.pose.header;
    pose.stamp = static_cast<pcrb::Stamp>(header.stamp.toNSec());
    pose.place = path + ", " + topic + " at " + pcrb::formatStamp(pose.stamp);
    if (pcrb::withoutSlash(header.frame_id) != pcrb::withoutSlash(frame)) {
      throw pcrb::InvalidFile(pose.place, 0, "a pose in the frame `" + header.frame_id + "`",
                              "`" + frame + "`");
    }
    poses.push_back(std::move(pose));
  });
  if (poses.empty()) {
    throw pcrb::InvalidFile(path, 0, "no message on `" + topic + "`", "poses (--topic)");
  }
  return poses;
}

std::vector<RecordedPose> readPoses(const std::string& path, const std::string& topic,
                                    const std::string& frame) {
  if (std::filesystem::path(path).extension() != ".bag") return readPoseTable(path);
  if (topic.empty()) {
    throw pcrb::InvalidParameter("found no --topic, expected that of the poses in " + path);
  }
  return readBagPoses(path, topic, frame);
}

}  // namespace pcrb_tools
