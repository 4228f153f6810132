#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/time.h>
#include <topic_tools/shape_shifter.h>

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// A pose as a node published it: of `frame` in `parent`, at `stamp`.
struct PublishedPose {
  ros::Time stamp;
  std::string parent;  ///< empty where the message does not say
  std::string frame;   ///< empty where the message does not say
  Transform T_parent_frame = Transform::Identity();
  std::optional<std::array<double, 36>> covariance;  ///< row-major x y z rx ry rz, finite
};

/// @throws InvalidProblem  for numbers that are no pose.
PublishedPose publishedPose(const geometry_msgs::TransformStamped& message);

/// Reads poses of a topic whose type is found when its first message comes: PoseStamped,
/// PoseWithCovarianceStamped, TransformStamped (geometry_msgs) or Odometry (nav_msgs).
class AnswerSource {
 public:
  using Listener = std::function<void(const PublishedPose&)>;

  AnswerSource(ros::NodeHandle& node, const std::string& topic, Listener listener);

  /// What is wrong with the messages, empty if nothing is: their type, or numbers that are no pose.
  const std::string& mistake() const { return mistake_; }

 private:
  void take(const topic_tools::ShapeShifter::ConstPtr& message);

  std::string topic_;
  Listener listener_;
  std::string mistake_;
  ros::Subscriber subscriber_;
};

}  // namespace pcrb
