#pragma once

#include <pcrb_msgs/Problem.h>
#include <pcrb_msgs/SubmitPose.h>
#include <pcrb_msgs/Summary.h>
#include <ros/node_handle.h>
#include <ros/service_client.h>
#include <ros/subscriber.h>
#include <sensor_msgs/PointCloud2.h>

#include <functional>

namespace pcrb {

/// A client's side of the benchmark's interface: the newest message of each topic, and the two
/// services, over connections that are kept and made anew after the server was restarted.
///
/// Messages may come in any order, and the server before or after the client; a problem's messages
/// are told by their stamps. A server that was restarted announces the problem in flight once more,
/// under the same id and another stamp. Single-threaded: works in the callbacks of the node's
/// queue.
class ServerConnection {
 public:
  /// @param changed  called after a problem, target or source has come; may be empty.
  explicit ServerConnection(std::function<void()> changed);

  /// The problem announced last, or nullptr.
  const pcrb_msgs::ProblemConstPtr& problem() const { return problem_; }

  /// The problem's target, its source, if they have come, else nullptr.
  sensor_msgs::PointCloud2ConstPtr target() const;
  sensor_msgs::PointCloud2ConstPtr source() const;

  /// Whether the server has said that the run is over.
  bool isFinished() const { return is_finished_; }

  /// Calls `ready` for the problem announced last; warns and returns false if no server answers.
  bool callReady();

  /// Submits a reply; warns if no server answers or it is rejected.
  void submit(const pcrb_msgs::SubmitPose::Request& request);

 private:
  template <typename Message>
  ros::Subscriber subscribe(const char* topic, boost::shared_ptr<Message const>& newest);

  std::function<void()> changed_;
  bool is_finished_ = false;
  pcrb_msgs::ProblemConstPtr problem_;
  sensor_msgs::PointCloud2ConstPtr target_;
  sensor_msgs::PointCloud2ConstPtr source_;

  ros::NodeHandle node_;
  ros::ServiceClient ready_;
  ros::ServiceClient submit_;
  ros::Subscriber problem_subscriber_;
  ros::Subscriber target_subscriber_;
  ros::Subscriber source_subscriber_;
  ros::Subscriber summary_subscriber_;
};

}  // namespace pcrb
