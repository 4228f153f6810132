#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/time.h>
#include <topic_tools/shape_shifter.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bridge/answer_diagnosis.hpp"
#include "pcrb_core/transform.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

/// A pose as a node published it: of `frame` in `parent`, at `stamp`.
struct PublishedPose {
  ros::Time stamp;
  std::string parent;  ///< empty where the message does not say
  std::string frame;   ///< empty where the message does not say
  Transform T_parent_frame = Transform::Identity();
  std::optional<PoseCovariance> covariance;
};

/// @throws InvalidProblem  for numbers that are no pose.
PublishedPose publishedPose(const geometry_msgs::TransformStamped& message);

/// Reads poses of a topic whose type is found when its first message comes: PoseStamped,
/// PoseWithCovarianceStamped, TransformStamped (geometry_msgs) or Odometry (nav_msgs).
class AnswerSource {
 public:
  using Listener = std::function<void(const PublishedPose&)>;
  using FaultListener = std::function<void(AnswerFault, const std::string& text)>;

  /// @param faults  called for messages of another type and for numbers that are no pose.
  AnswerSource(ros::NodeHandle& node, const std::string& topic, Listener listener,
               FaultListener faults);

  bool isPublished() const { return subscriber_.getNumPublishers() > 0; }

 private:
  void take(const topic_tools::ShapeShifter::ConstPtr& message);

  std::string topic_;
  Listener listener_;
  FaultListener faults_;
  ros::Subscriber subscriber_;
};

/// Whether AnswerSource reads a type, e.g. `nav_msgs/Odometry`.
bool isPoseType(const std::string& type);

/// Topics of a type that AnswerSource reads, with the other nodes that publish them; empty if the
/// master does not answer.
///
/// @param excluded  topic to leave out.
std::vector<PoseTopic> publishedPoseTopics(const std::string& excluded);

}  // namespace pcrb
