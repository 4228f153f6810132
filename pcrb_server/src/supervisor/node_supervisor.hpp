#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>

#include "pcrb_server/node_main.hpp"
#include "ros/node_calls.hpp"
#include "supervisor/supervised_command.hpp"

namespace pcrb {

/// Parameters of `node_supervisor`; its --help says what each means.
struct SupervisorParameters {
  std::vector<std::string> command;  ///< roslaunch with its arguments
  bool autostart = true;
};

extern const ParameterTable kSupervisorParameters;

/// @throws InvalidParameter  listing every mistake.
SupervisorParameters readSupervisorParameters();

/// Checks the launch file's arguments, and notes what it starts as ~provenance, which the server
/// puts into the run's table.
/// @throws Error  if it does not take its arguments, or cannot be read; why is printed.
void describeLaunch(const SupervisorParameters& parameters, const ShutdownRequest& shutdown);

/// Runs a user's launch file as a child, and starts it anew when it dies or on request.
class NodeSupervisor {
 public:
  NodeSupervisor(const SupervisorParameters& parameters, ShutdownRequest& shutdown);
  ~NodeSupervisor();

  /// Until the shutdown or the end of the process that started this one; ends the child.
  /// @throws Error  if the child keeps dying as soon as it is started, and no problem ends
  /// meanwhile.
  void run();

 private:
  TriggerAnswer restart();
  void answerRequest();
  void keepAlive();
  void start();
  bool takeResult();

  SupervisedCommand command_;
  ShutdownRequest& shutdown_;
  const pid_t parent_;    ///< roslaunch, which may be killed
  bool is_wanted_;        ///< whether the child should run
  int early_deaths_ = 0;  ///< in a row, without a result between them
  std::chrono::steady_clock::time_point started_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_requested_ = false;
  bool is_over_ = false;
  bool has_result_ = false;  ///< whether a problem has ended since the last death

  ros::NodeHandle node_{"~"};
  ros::ServiceServer service_;
  ros::Subscriber results_;
  ros::AsyncSpinner spinner_{1};
};

}  // namespace pcrb
