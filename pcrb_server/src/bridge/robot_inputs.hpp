#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bridge/bridge_parameters.hpp"
#include "bridge/frames.hpp"
#include "bridge/setup_check.hpp"
#include "bridge/straight_motion.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/transform.hpp"
#include "ros/topic_peers.hpp"

namespace pcrb {

inline std::int64_t toNanoseconds(double seconds) { return std::llround(seconds * 1e9); }

inline std::int64_t toNanoseconds(const ros::Time& time) {
  return static_cast<std::int64_t>(time.toNSec());
}

inline ros::Time toTime(std::int64_t nanoseconds) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(nanoseconds));
}

/// Stamps of all that the bridge sends, ns: unique, strictly increasing, and none later than now.
///
/// Within a problem scans follow each other by the same spacing, however long the node takes to
/// answer: filters predict over the time between stamps.
class StampClock {
 public:
  /// @param is_even  false: scans are stamped with the time at which they are sent.
  explicit StampClock(bool is_even) : is_even_(is_even) {}

  /// A stamp for what is sent now.
  std::int64_t now(std::int64_t time) { return last_ = std::max(time, last_ + 1); }

  /// The stamp of a scan after the first one of its problem.
  /// @param time  now, at least `spacing` ns after the scan before was sent.
  std::int64_t next(std::int64_t time, std::int64_t spacing) {
    return last_ = is_even_ ? last_ + spacing : std::max(time, last_ + 1);
  }

 private:
  bool is_even_;
  std::int64_t last_ = 0;
};

/// How the benchmark's source becomes the scan of a robot's sensor.
struct SensorMounting {
  Transform T_scan_source = Transform::Identity();  ///< turns the source into the scan that is sent
  Transform T_base_scan = Transform::Identity();    ///< how the sensor is mounted

  Transform T_base_source() const { return T_base_scan * T_scan_source; }
};

/// What a localization node gets from the bridge, as it would from a robot: map, scan, initial
/// pose, links of tf, and, if asked for, odometry and an IMU. These tell of a robot that stands
/// still, or of the same straight motion in every problem: they say nothing about the problem.
/// Stamps, odometry and tf are continuous over all problems.
class RobotInputs {
 public:
  /// @throws Error  if another bridge writes its maps to ~map_file.
  RobotInputs(ros::NodeHandle& node, const BridgeParameters& parameters);

  /// Publishes the static links of tf.
  void sendStaticLinks();

  /// Frames whose parent this publishes.
  std::map<std::string, OwnedFrame> ownedFrames() const { return links_.ownedChildren(); }

  /// Publishes the map, latched, and writes it to ~map_file if there is one.
  /// @throws InvalidFile  if the file cannot be written.
  void sendMap(const PointCloud& map);

  void sendInitialPose(const Transform& T_map_body);

  /// The scan that sendScan() sends from now on: of a cloud by a sensor that is mounted like that.
  void setScan(const PointCloud& cloud, const SensorMounting& mounting);

  /// A scan that was sent.
  struct SentScan {
    std::int64_t stamp = 0;                          ///< ns
    Transform T_first_base = Transform::Identity();  ///< the body's way since the first one
  };

  /// Publishes the dynamic links of tf, odometry, IMU and the scan, all up to one stamp.
  SentScan sendScan(bool is_first_of_problem);

  /// The robot brakes.
  void stop();

  /// s until it stands still.
  double timeToStop();

  /// Publishes odometry and IMU at their rates up to now, from the time of the call before; stamps
  /// too far back are left out.
  void sendMotion();

  /// Name of each node under test, and how often it has left: of those that ever took scans and the
  /// initial pose, if there are any; of all that took one of the two, but the observers, otherwise.
  std::map<std::string, int> departures() const;

  /// Those of them that are there now, and how often each has come.
  std::map<std::string, int> nodes() const;

  /// All that take scan, map or initial pose now, observers excepted.
  std::set<std::string> allNodes() const;

  /// What is sent and no node subscribes to now.
  std::vector<RobotTopic> untaken() const;

  bool isObserver(const std::string& node) const { return scan_listeners_.isObserver(node); }

  bool isScanTaken() const { return !scan_listeners_.names().empty(); }
  bool isInitialPoseTaken() const { return !initial_pose_listeners_.names().empty(); }

 private:
  /// Something that is sent at a rate.
  struct Stream {
    ros::Publisher publisher;
    ros::Duration period;
    ros::Time last;
  };

  template <typename Make>
  void send(Stream& stream, const Make& make, const ros::Time& until);

  Transform odometryAt(const ros::Time& stamp) const;

  /// The message of the scan for a body that has gone so far since the first one.
  void makeScan(const Transform& T_first_base);

  void sendMotion(const ros::Time& until);
  ros::Time now() { return toTime(clock_.now(toNanoseconds(ros::Time::now()))); }

  const BridgeParameters& parameters_;
  TfLinks links_;
  StampClock clock_;
  std::optional<FileLock> map_file_lock_;
  SubscriberNames map_listeners_;
  SubscriberNames scan_listeners_;
  SubscriberNames initial_pose_listeners_;
  StraightMotion motion_;
  PointCloud scan_cloud_;
  SensorMounting scan_mounting_;
  sensor_msgs::PointCloud2 scan_message_;
  Transform scan_way_ = Transform::Identity();      ///< of the body, that scan_message_ is for
  Transform T_odom_first_ = Transform::Identity();  ///< of the body at the problem's first scan
  ros::Publisher map_;
  ros::Publisher scan_;
  ros::Publisher initial_pose_;
  Stream imu_;
  Stream odometry_;
};

}  // namespace pcrb
