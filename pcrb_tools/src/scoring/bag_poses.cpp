#include "archives/pose_messages.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "scoring/recorded_poses.hpp"

namespace pcrb_tools {
namespace {

/// A pose as a client would have submitted it.
pcrb::Submission submissionOf(const PoseMessage& message) {
  const auto& position = message.pose.pose.position;
  const auto& q = message.pose.pose.orientation;
  pcrb::Submission submission;
  submission.position = {position.x, position.y, position.z};
  submission.orientation = Eigen::Quaterniond(q.w, q.x, q.y, q.z);
  submission.covariance = pcrb::covarianceOf(message.pose);
  return submission;
}

}  // namespace

std::vector<RecordedPose> readBagPoses(const std::string& path, const std::string& topic,
                                       const std::string& frame) {
  const BagMessages bag({path});
  std::vector<RecordedPose> poses;
  bag.forEach({topic}, [&](const rosbag::MessageInstance& instance) {
    for (const PoseMessage& message : posesOf(instance)) {
      const std_msgs::Header& header = message.header;
      RecordedPose pose;
      pose.reply.submission = submissionOf(message);
      pose.stamp = pcrb::stampOf(header.stamp);
      pose.place = path + ", " + topic + " at " + pcrb::formatStamp(pose.stamp);
      if (pcrb::withoutSlash(header.frame_id) != pcrb::withoutSlash(frame)) {
        throw pcrb::InvalidFile(pose.place, 0, "a pose in the frame `" + header.frame_id + "`",
                                "`" + frame + "`");
      }
      poses.push_back(std::move(pose));
    }
  });
  if (poses.empty()) {
    throw pcrb::InvalidFile(path, 0, "no message on `" + topic + "` among " + bag.describeTopics(),
                            std::string(kPoseTypes) + " (--topic)");
  }
  return poses;
}

std::vector<RecordedPose> readPoses(const std::string& path, const std::string& topic,
                                    const std::string& frame) {
  if (!isBag(path)) return readPoseTable(path);
  if (topic.empty()) {
    throw pcrb::InvalidParameter("found no --topic, expected that of the poses in " + path);
  }
  return readBagPoses(path, topic, frame);
}

}  // namespace pcrb_tools
