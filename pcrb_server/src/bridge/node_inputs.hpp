#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>
#include <sensor_msgs/PointCloud2.h>

#include <map>
#include <optional>
#include <set>
#include <string>

#include "bridge/bridge_parameters.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/transform.hpp"
#include "subscriber_names.hpp"

namespace pcrb {

/// What a localization node gets from the bridge, apart from tf: map, scan, initial pose, and, if
/// asked for, odometry that stands still and an IMU that feels gravity alone. These two are
/// constants in the body's frame: they say nothing about the problem.
class NodeInputs {
 public:
  /// @throws Error  if another bridge writes its maps to ~map_file.
  NodeInputs(ros::NodeHandle& node, const BridgeParameters& parameters);

  /// Publishes the map, latched, and writes it to ~map_file if there is one.
  /// @throws InvalidFile  if the file cannot be written.
  void sendMap(const PointCloud& map, const ros::Time& stamp);

  void sendInitialPose(const Transform& T_map_body, const ros::Time& stamp);

  /// The scan that sendScan() sends from now on: T · cloud.
  void setScan(const PointCloud& cloud, const Transform& T);
  void sendScan(const ros::Time& stamp);

  /// Publishes odometry and IMU at their rates up to a time, from the time of the call before;
  /// stamps too far back are left out.
  void sendMotion(const ros::Time& until);

  /// Name of each node under test that ever took scans, and how often it has left: of those that
  /// take the initial pose, too, if there are any; of all but the observers otherwise.
  std::map<std::string, int> departures() const;

  /// Those of them that are there now.
  std::map<std::string, int> nodes() const;

  /// All that take scan, map or initial pose now, observers excepted.
  std::set<std::string> allNodes() const;

  bool isObserver(const std::string& node) const { return scan_listeners_.isObserver(node); }

  bool isInitialPoseTaken() const { return !initial_pose_listeners_.names().empty(); }

 private:
  /// Something that is sent at a rate.
  struct Stream {
    ros::Publisher publisher;
    ros::Duration period;
    ros::Time last;
  };

  template <typename Message>
  void send(Stream& stream, Message message, const ros::Time& until);

  const BridgeParameters& parameters_;
  std::optional<FileLock> map_file_lock_;
  SubscriberNames map_listeners_;
  SubscriberNames scan_listeners_;
  SubscriberNames initial_pose_listeners_;
  sensor_msgs::PointCloud2 scan_message_;
  ros::Publisher map_;
  ros::Publisher scan_;
  ros::Publisher initial_pose_;
  Stream imu_;
  Stream odometry_;
};

}  // namespace pcrb
