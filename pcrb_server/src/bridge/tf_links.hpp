#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "bridge/bridge_parameters.hpp"

namespace pcrb {

/// The tf links map → odom → base → scan that the bridge publishes; all are the identity.
class TfLinks {
 public:
  explicit TfLinks(const BridgeParameters& parameters) : parameters_(parameters) {}

  void sendStatic(const ros::Time& stamp);

  /// Publishes the dynamic links with a scan's stamp.
  void sendDynamic(const ros::Time& stamp);

  /// Frames whose parent the bridge says: nobody else may. Each with the parameter that says so.
  std::map<std::string, std::string> ownedChildren() const;

 private:
  struct Link {
    TfLink kind;
    const char* parameter;
    const std::string& parent;
    const std::string& child;
  };

  std::array<Link, 3> all() const;
  std::vector<geometry_msgs::TransformStamped> links(TfLink kind, const ros::Time& stamp) const;

  const BridgeParameters& parameters_;
  tf2_ros::TransformBroadcaster dynamic_;
  tf2_ros::StaticTransformBroadcaster static_;
};

}  // namespace pcrb
