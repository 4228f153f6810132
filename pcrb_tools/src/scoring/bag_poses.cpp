#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>

#include <filesystem>

#include "archives/bag_messages.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "scoring/recorded_poses.hpp"

namespace pcrb_tools {
namespace {

/// A pose as a client would have submitted it, and the header of its message.
struct BagPose {
  std_msgs::Header header;
  pcrb::Submission submission;
};

template <typename Vector>
BagPose makeBagPose(const std_msgs::Header& header, const Vector& position,
                    const geometry_msgs::Quaternion& q) {
  BagPose pose{header, {}};
  pose.submission.position = {position.x, position.y, position.z};
  pose.submission.orientation = Eigen::Quaterniond(q.w, q.x, q.y, q.z);
  return pose;
}

BagPose makeBagPose(const std_msgs::Header& header,
                    const geometry_msgs::PoseWithCovariance& estimate) {
  BagPose pose = makeBagPose(header, estimate.pose.position, estimate.pose.orientation);
  pose.submission.covariance = pcrb::covarianceOf(estimate);
  return pose;
}

/// Of a message of any of the types that hold a pose.
BagPose makeBagPose(const rosbag::MessageInstance& message) {
  if (const auto stamped = message.instantiate<geometry_msgs::PoseStamped>()) {
    return makeBagPose(stamped->header, stamped->pose.position, stamped->pose.orientation);
  }
  if (const auto stamped = message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()) {
    return makeBagPose(stamped->header, stamped->pose);
  }
  if (const auto odometry = message.instantiate<nav_msgs::Odometry>()) {
    return makeBagPose(odometry->header, odometry->pose);
  }
  if (const auto stamped = message.instantiate<geometry_msgs::TransformStamped>()) {
    const auto& transform = stamped->transform;
    return makeBagPose(stamped->header, transform.translation, transform.rotation);
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
    const BagPose found = makeBagPose(message);
    const std_msgs::Header& header = found.header;
    RecordedPose pose;
    pose.reply.submission = found.submission;
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
