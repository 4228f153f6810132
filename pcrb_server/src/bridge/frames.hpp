#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bridge/bridge_parameters.hpp"
#include "pcrb_core/transform.hpp"

/// The frames between the benchmark's map and the sensor: their poses, and the nodes that publish
/// them.
namespace pcrb {

/// The benchmark's poses are those of the sensor, a localization node's those of its body
/// (`base_link`). With E = T_body_sensor one follows from the other.

/// T_map_body of a sensor's pose: T_map_sensor · E⁻¹.
inline Transform bodyPose(const Transform& T_map_sensor, const Transform& T_body_sensor) {
  return T_map_sensor * T_body_sensor.inverse();
}

/// T_map_sensor of a body's pose: T_map_body · E.
inline Transform sensorPose(const Transform& T_map_body, const Transform& T_body_sensor) {
  return T_map_body * T_body_sensor;
}

/// The rotation that takes the points of an optical frame (REP 103: z forward, x right, y down) to
/// the axes of a body (x forward, y left, z up) at the same place, and rolls it upright, so that
/// its y lies level in the map where the initial guess puts it.
///
/// @param T_map_optical  the initial guess; without one the roll stays as it is.
Transform uprightFromOptical(const std::optional<Transform>& T_map_optical);

/// A frame whose parent the bridge publishes on tf.
struct OwnedFrame {
  std::string parameter;  ///< that decides it
  std::string parent;
  bool is_scan = false;
};

/// That the IMU's gravity, which is that of a level robot, is not the one that this initial pose of
/// a local problem allows; empty if it may be.
std::string warningOfTilt(const Transform& T_map_base);

/// What to do about another node that publishes such a frame: it localizes the sensor itself, or
/// publishes the link as it should, or should not be there.
std::string adviceOn(const OwnedFrame& owned, const std::string& frame, const std::string& parent);

/// The tf links map → odom → base → scan that the bridge publishes; all are the identity, but for
/// odom → base of a robot that moves.
class TfLinks {
 public:
  explicit TfLinks(const BridgeParameters& parameters) : parameters_(parameters) {}

  void sendStatic(const ros::Time& stamp);

  /// Publishes the dynamic links with a scan's stamp.
  void sendDynamic(const ros::Time& stamp, const Transform& T_odom_base);

  /// Frames whose parent the bridge publishes: no other node may.
  std::map<std::string, OwnedFrame> ownedChildren() const;

 private:
  struct Link {
    TfLink kind;
    const char* parameter;
    const std::string& parent;
    const std::string& child;
    bool is_moving = false;
  };

  std::array<Link, 3> all() const;
  std::vector<geometry_msgs::TransformStamped> links(TfLink kind, const ros::Time& stamp,
                                                     const Transform& T_odom_base) const;

  const BridgeParameters& parameters_;
  tf2_ros::TransformBroadcaster dynamic_;
  tf2_ros::StaticTransformBroadcaster static_;
};

/// Listens to tf: looks frames up, and sees which node publishes what.
class TfWatch {
 public:
  /// Called for every transform of /tf that another node publishes.
  using Listener = std::function<void(const geometry_msgs::TransformStamped&)>;

  /// @param owned  child frames whose publisher is this node alone.
  TfWatch(ros::NodeHandle& node, std::map<std::string, OwnedFrame> owned, Listener listener);

  /// T_target_frame at a time (0: the newest), or nothing where tf does not connect the two.
  std::optional<Transform> find(const std::string& target, const std::string& frame,
                                const ros::Time& stamp) const;

  /// All frames that were on tf.
  const std::set<std::string>& frames() const { return frames_; }

  /// The node that publishes a child frame of this one, the frame, and what to do if that is as it
  /// should be; empty if there is none.
  const std::string& conflict() const { return conflict_; }

 private:
  void take(const ros::MessageEvent<tf2_msgs::TFMessage const>& event, bool is_static);

  std::map<std::string, OwnedFrame> owned_;
  Listener listener_;
  std::string conflict_;
  std::set<std::string> frames_;
  tf2::BufferCore buffer_;
  ros::Subscriber tf_;
  ros::Subscriber tf_static_;
};

}  // namespace pcrb
