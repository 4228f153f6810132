#pragma once

#include <pcrb_msgs/Result.h>
#include <pcrb_msgs/Summary.h>
#include <ros/node_handle.h>

#include <chrono>
#include <string>
#include <vector>

#include "pcrb_server/node_main.hpp"

namespace pcrb {

/// Watches the run of the benchmark server in this node's namespace until it is over.
///
/// A server that waits for ~start starts when this listens to it: with a fast client, the run could
/// be over before. While this lives, the server sees a reader of its summary and stays (its
/// ~linger).
class RunWatcher {
 public:
  /// @param server   name of the server's node, relative to the namespace.
  /// @param clients  names of nodes without which no problem is solved.
  RunWatcher(const std::string& server, const std::vector<std::string>& clients);

  /// Waits for the summary of a finished run.
  ///
  /// @param limit  s from now.
  /// @throws Error  if there is none: the server did not start or has ended before (SIGKILL
  ///                included), a client did not start or gave up, the limit was reached, a signal
  ///                came. The message says how far the run was.
  pcrb_msgs::Summary wait(double limit, const ShutdownRequest& shutdown);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Server { kAbsent, kRegistered, kServing };
  struct Client {
    std::string name;
    bool is_seen = false;
    int absences = 0;  ///< looks in a row that did not find it
  };

  void listen();
  void startRun();
  Server lookForServer() const;
  bool hasServerEnded();
  void look(double waited);
  void lookForClients(double waited);
  [[noreturn]] void fail(const std::string& what) const;

  ros::NodeHandle node_;
  std::string server_;
  std::vector<Client> clients_;
  Server seen_ = Server::kAbsent;  ///< the most that was seen of it
  int absences_ = 0;               ///< looks in a row that found less
  Clock::time_point looked_;
  bool is_started_ = false;
  ros::Subscriber summary_subscriber_;
  ros::Subscriber result_subscriber_;
  pcrb_msgs::SummaryConstPtr summary_;
  pcrb_msgs::ResultConstPtr newest_;
};

}  // namespace pcrb
