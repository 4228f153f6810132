#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <atomic>
#include <string>
#include <vector>

#include "pcrb_core/run/run_plan.hpp"
#include "pcrb_core/run/run_record.hpp"
#include "pcrb_server/node_main.hpp"
#include "server/problem_loader.hpp"
#include "server/problem_session.hpp"
#include "server/publications.hpp"
#include "server/replies.hpp"
#include "server/run_clients.hpp"
#include "server/server_parameters.hpp"

namespace pcrb {

/// The referee: hands problems out one after the other, scores the replies, and keeps the results.
///
/// One thread (the caller's) runs the loop; services run in threads of their own; problems are
/// prepared one ahead in another. A result is on the disk before the next problem is announced.
class BenchmarkServer {
 public:
  /// Opens or resumes the run and offers topics and services.
  /// @throws Error  if the run cannot be posed.
  BenchmarkServer(const ServerParameters& parameters, ShutdownRequest& shutdown);
  ~BenchmarkServer();
  BenchmarkServer(const BenchmarkServer&) = delete;
  BenchmarkServer& operator=(const BenchmarkServer&) = delete;

  /// Serves every problem that has no result yet, then writes and publishes the summary.
  ///
  /// @return  true if every problem of the run has a result in the end, and none was skipped
  ///          unless that is allowed.
  /// @throws Error  if nobody comes for a problem, or a cloud cannot be served.
  bool run();

 private:
  void offerServices();
  void offerControls();
  void waitForStart();
  bool serve(PreparedProblem prepared);
  Announcement nextAnnouncement(const PreparedProblem& prepared);
  void waitForReaders(bool had_readers, int departures);
  bool conclude();

  const ServerParameters& parameters_;
  ShutdownRequest& shutdown_;
  RunPlan plan_;
  RunRecord record_;
  std::vector<PlannedProblem> remaining_;
  std::size_t done_ = 0;  ///< problems that have a result
  ros::Time last_stamp_;
  std::atomic<bool> is_paused_;

  ros::NodeHandle node_;
  ros::CallbackQueue service_queue_;
  TfLookup tf_;
  ProblemSession session_;
  Publications publications_;
  RunClients clients_;
  ProblemLoader loader_;
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_;          ///< for subscriptions: tf
  ros::AsyncSpinner service_spinner_;  ///< for services
};

}  // namespace pcrb
