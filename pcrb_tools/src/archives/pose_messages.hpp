#pragma once

#include <geometry_msgs/PoseWithCovariance.h>
#include <std_msgs/Header.h>

#include <string>
#include <vector>

#include "archives/bag_messages.hpp"
#include "pcrb_core/datasets/trajectory.hpp"

namespace pcrb_tools {

/// A pose of a message of any type that holds one, T_frame_child.
struct PoseMessage {
  std_msgs::Header header;
  std::string child_frame;                 ///< empty where the type names none
  geometry_msgs::PoseWithCovariance pose;  ///< covariance: zeros where the type has none
};

/// The types that posesOf() reads, as a list for messages.
extern const char* const kPoseTypes;

/// Whether a type of ROS is one of kPoseTypes.
bool isPoseType(const std::string& type);

/// The poses of a message; of a nav_msgs/Path all of its own.
/// @throws InvalidFile  if it is of another type.
std::vector<PoseMessage> posesOf(const rosbag::MessageInstance& message);

/// The transform of a message's pose.
/// @param place  of the message, for errors
/// @throws InvalidFile  for numbers that are no pose.
pcrb::Transform transformOf(const PoseMessage& message, const std::string& place);

/// The poses of a topic of a bag, T_world_body in time.
struct BagTrajectory {
  pcrb::Trajectory trajectory;
  std::string world_frame;  ///< without a leading slash
  std::string body_frame;   ///< empty where the type names none
};

/// @throws InvalidFile  if there is no message, or they differ in their frames.
BagTrajectory readBagTrajectory(const BagMessages& bags, const std::string& topic);

}  // namespace pcrb_tools
