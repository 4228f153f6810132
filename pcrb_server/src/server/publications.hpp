#pragma once

#include <pcrb_msgs/Result.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <set>
#include <string>
#include <vector>

#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/run/result.hpp"
#include "pcrb_core/run/summary.hpp"
#include "ros/problem_messages.hpp"
#include "ros/topic_peers.hpp"
#include "server/problem_loader.hpp"
#include "server/server_parameters.hpp"

namespace pcrb {

/// Everything that the server publishes. Nothing here gives a problem's answer away before it has
/// ended.
class Publications {
 public:
  Publications(ros::NodeHandle& node, const ServerParameters& parameters);

  /// Publishes the target, if it has changed, and the problem.
  void publishProblem(const PreparedProblem& prepared, const Announcement& announcement);

  /// Publishes the initial guess, where there is one, and the source.
  void publishSource(const PreparedProblem& prepared, const Announcement& announcement);

  /// Publishes a stored result, and where the reply puts the source.
  void publishResult(const PreparedProblem& prepared, const Announcement& announcement,
                     const Result& result);

  /// Publishes the results of this session again, with their errors, unless they were live.
  void publishErrors();

  void publishSummary(const std::vector<SequenceSummary>& summaries, bool finished);

  bool hasSummaryReaders() const { return summary_.getNumSubscribers() > 0; }

  /// How often a subscriber of the summary has left.
  int summaryDepartures() const;

  /// Nodes that listen to `problem`; those that only watch (rviz, rosbag, rostopic) excepted.
  std::set<std::string> listeners() const { return listeners_.names(); }

 private:
  void publishTarget(const PreparedProblem& prepared, const Announcement& announcement);
  bool areErrorsPublic() const { return parameters_.configuration.results == ResultsTime::kLive; }
  void publishOrWithhold(pcrb_msgs::Result message);
  void showReply(const PreparedProblem& prepared, const Announcement& announcement,
                 const Result& result);
  void showTruth(const PreparedProblem& prepared, const Announcement& announcement);
  void broadcast(const std::string& parent, const std::string& child, const Transform& T,
                 const ros::Time& stamp, bool is_static);

  const ServerParameters& parameters_;
  ros::Time target_stamp_;
  bool is_earth_known_ = false;  ///< whether earth → map was broadcast before

  std::vector<pcrb_msgs::Result> withheld_;  ///< results whose errors were not published yet

  SubscriberNames listeners_;
  SubscriberNames summary_readers_{std::vector<std::string>()};

  tf2_ros::TransformBroadcaster tf_;
  tf2_ros::StaticTransformBroadcaster static_tf_;
  ros::Publisher target_;
  ros::Publisher source_;
  ros::Publisher problem_;
  ros::Publisher initial_pose_;
  ros::Publisher result_;
  ros::Publisher summary_;
  ros::Publisher source_aligned_;
  ros::Publisher markers_;
  ros::Publisher truth_;
  ros::Publisher perturbation_;
};

}  // namespace pcrb
