#pragma once

#include <pcrb_msgs/Problem.h>
#include <pcrb_msgs/SubmitPose.h>
#include <ros/time.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "pcrb_core/registration/registration.hpp"
#include "pcrb_server/server_connection.hpp"

namespace pcrb_tools {

/// A client of the benchmark: subscribes, aligns with one method, submits.
///
/// Whatever the method throws fails the problem, not the run; what is no pcrb::Error also costs it
/// its life: another one is made. Single-threaded: all happens in the callbacks of the node's
/// queue.
class RegistrationClient {
 public:
  /// Makes a method for the data set of a problem (its parameters may depend on it).
  using MethodFactory =
      std::function<std::unique_ptr<pcrb::Registration>(const pcrb_msgs::Problem& problem)>;

  explicit RegistrationClient(MethodFactory make_method);

  /// Whether the server has said that the run is over.
  bool finished() const { return server_.isFinished(); }

 private:
  void advance();
  bool prepareTarget();
  void solve();
  void align(pcrb_msgs::SubmitPose::Request& reply);

  /// Why an action of the method failed, if it did. There is no method afterwards if it is broken.
  std::optional<std::string> failureOf(const std::function<void()>& action);

  MethodFactory make_method_;
  std::unique_ptr<pcrb::Registration> method_;
  std::string data_set_;                       ///< that method_ was made for
  ros::Time prepared_stamp_;                   ///< of the target that was prepared last
  std::optional<std::string> target_failure_;  ///< why the method cannot use that target
  ros::Time ready_stamp_;                      ///< of the problem that ready was called for
  ros::Time solved_stamp_;                     ///< of the problem that was answered last

  pcrb::ServerConnection server_;
};

}  // namespace pcrb_tools
