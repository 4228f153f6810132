#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <tf2_msgs/TFMessage.h>

#include <string>
#include <vector>

#include "pcrb_server/message_conversion.hpp"
#include "support/bag_writer.hpp"

namespace pcrb_test {

/// The time of the k-th scan of a log of one's own: ten a second.
inline ros::Time scanTime(std::uint32_t k) { return {1500000000 + k / 10, k % 10 * 100000000}; }

/// Where its body was then: on the way along x, turned by a quarter.
inline pcrb::Transform bodyAt(std::uint32_t k) {
  pcrb::Transform T = pcrb::Transform::Identity();
  T.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  T.translation() = Eigen::Vector3d(0.5 * k, 2, 3);
  return T;
}

/// The sensor in the body.
inline pcrb::Transform sensorInBody() {
  return pcrb::Transform(Eigen::Translation3d(0.25, 0, 1.5));
}

/// The scan's only points, in the sensor's frame.
inline const std::vector<float>& scanPoints() {
  static const std::vector<float> kPoints{1, 2, 3, -4, 5, 0.5};
  return kPoints;
}

inline std_msgs::Header header(const std::string& frame, std::uint32_t k) {
  std_msgs::Header made;
  made.stamp = scanTime(k);
  made.frame_id = frame;
  return made;
}

inline tf2_msgs::TFMessage tfOf(const pcrb::Transform& T, const std::string& parent,
                                const std::string& child, std::uint32_t k) {
  tf2_msgs::TFMessage message;
  message.transforms.push_back(pcrb::toMessage(T, header(parent, k), child));
  return message;
}

inline nav_msgs::Odometry odometryAt(std::uint32_t k) {
  nav_msgs::Odometry odometry;
  odometry.header = header("map", k);
  odometry.child_frame_id = "base_link";
  odometry.pose.pose = pcrb::toMessage(bodyAt(k));
  return odometry;
}

inline geometry_msgs::PoseStamped poseAt(std::uint32_t k) {
  geometry_msgs::PoseStamped pose;
  pose.header = header("map", k);
  pose.pose = pcrb::toMessage(bodyAt(k));
  return pose;
}

/// A bag of scans on /velodyne_points, to which poses are added.
class OwnBagWriter {
 public:
  explicit OwnBagWriter(const std::string& path, std::uint32_t scans = 4)
      : bag_(path, rosbag::bagmode::Write) {
    for (std::uint32_t k = 0; k != scans; ++k) {
      bag_.write("/velodyne_points", scanTime(k), makeCloud(header("velodyne", k), scanPoints()));
    }
  }

  template <typename Message>
  OwnBagWriter& add(const std::string& topic, std::uint32_t k, const Message& message) {
    bag_.write(topic, scanTime(k), message);
    return *this;
  }

  OwnBagWriter& addOdometry(std::uint32_t scans = 4) {
    for (std::uint32_t k = 0; k != scans; ++k) add("/odom", k, odometryAt(k));
    return *this;
  }

  OwnBagWriter& addExtrinsics() {
    return add("/tf_static", 0, tfOf(sensorInBody(), "base_link", "velodyne", 0));
  }

  OwnBagWriter& addTf(std::uint32_t scans = 4) {
    for (std::uint32_t k = 0; k != scans; ++k)
      add("/tf", k, tfOf(bodyAt(k), "map", "base_link", k));
    return *this;
  }

 private:
  rosbag::Bag bag_;
};

}  // namespace pcrb_test
