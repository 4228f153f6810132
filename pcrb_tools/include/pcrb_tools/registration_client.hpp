#pragma once

#include <pcrb_msgs/Problem.h>
#include <pcrb_msgs/SubmitPose.h>
#include <pcrb_msgs/Summary.h>
#include <ros/node_handle.h>
#include <sensor_msgs/PointCloud2.h>

#include <functional>
#include <memory>
#include <string>

#include "pcrb_core/registration/registration.hpp"

namespace pcrb_tools {

/// A client of the benchmark: subscribes, aligns with one method, submits.
///
/// Single-threaded: all happens in the callbacks of the node's queue. A message's place in time
/// does not matter: problem, target and source may arrive in any order, and before this node was
/// started. Announcements are told apart by their stamps: a server that was restarted announces the
/// problem in flight once more, under the same id.
class RegistrationClient {
 public:
  /// Makes a method for a data set (its parameters may depend on it).
  using MethodFactory =
      std::function<std::unique_ptr<pcrb::Registration>(const std::string& data_set)>;

  explicit RegistrationClient(MethodFactory make_method);

  /// Whether the server has said that the run is over.
  bool finished() const { return finished_; }

 private:
  void advance();
  bool prepareTarget();
  void callReady();
  void solve();
  pcrb_msgs::SubmitPose::Request align();
  void submit(const pcrb_msgs::SubmitPose::Request& request);

  MethodFactory make_method_;
  std::unique_ptr<pcrb::Registration> method_;
  std::string data_set_;        ///< that method_ was made for
  ros::Time prepared_stamp_;    ///< of the target that method_ has
  std::string target_failure_;  ///< why the method cannot use that target, else empty
  ros::Time ready_stamp_;       ///< of the problem that ready was called for
  ros::Time solved_stamp_;      ///< of the problem that was answered last
  bool finished_ = false;

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

}  // namespace pcrb_tools
