#pragma once

#include <ros/node_handle.h>
#include <sys/types.h>

#include <map>
#include <optional>
#include <set>
#include <string>

#include "bridge/bridge_parameters.hpp"
#include "bridge/robot_inputs.hpp"
#include "pcrb_server/processes.hpp"

namespace pcrb {

/// The processes of nodes: asks the master where a node is, and the node which process it is.
class NodeProcesses {
 public:
  /// Whether a node answers on its own port within `limit` s: a process that is stopped or spins in
  /// a loop with its lock held does not.
  static bool isAlive(const std::string& node, double limit);

  /// Looks at the processes of these nodes that run on this machine; nodelets of one manager are
  /// one process, counted once.
  ///
  /// @return  the CPU time since the call before (of a process seen for the first time: none) and
  ///          the greatest peak of memory so far, summed over processes; nothing if there is none.
  std::optional<ProcessUsage> usage(const std::set<std::string>& nodes);

 private:
  std::optional<pid_t> processOf(const std::string& node);

  std::map<std::string, std::optional<pid_t>> pids_;  ///< by node; nothing: elsewhere or unknown
  std::map<pid_t, double> cpu_times_;                 ///< s, at the call before
};

/// Watches over the node under test: its presence, death, hangs and use of resources; asks
/// `node_supervisor` for a new one.
///
/// A node is back when it has come again, which is seen at once; that it left may be seen later.
class NodeMonitor {
 public:
  NodeMonitor(ros::NodeHandle& node, const BridgeParameters& parameters, const RobotInputs& inputs);

  /// Call at the start of each problem.
  /// @param is_new_target  whether the problem's target is another one than that before.
  void beginProblem(bool is_new_target);

  /// Whether the node has to be restarted before the problem.
  bool needsRestart() const { return needs_restart_; }

  /// Asks the supervisor for a restart, which ends the node first; false, saying why, if no
  /// supervisor answers or the supervisor cannot.
  bool restart();

  /// Whether the node that was asked for is there.
  bool isThere() const;

  /// Call when the node is there: from now on it has the problem.
  void beginWatch();

  /// Takes those that came since beginWatch() for under test, too: new ones, and the next self of
  /// one that was there.
  void extendWatch();

  /// Whether the node has left since beginWatch().
  bool hasLeft() const;

  /// Call before the first scan of each problem.
  void beginPlay();

  /// Call after each problem.
  /// @param is_answered  whether the node answered one of its scans.
  void endProblem(bool is_answered);

  /// What the node has used since beginPlay(), if its processes are on this machine.
  std::optional<ProcessUsage> usage();

  /// Number of nodes that were followed by another, or have gone: another number, another node.
  int restartCount() const;

 private:
  bool isHanging() const;

  const BridgeParameters& parameters_;
  const RobotInputs& inputs_;
  ros::NodeHandle& node_;
  NodeProcesses processes_;
  bool needs_restart_ = false;
  std::map<std::string, int> before_;    ///< arrivals of the nodes before the new one's
  std::map<std::string, int> at_start_;  ///< arrivals of the nodes that have the problem
  int unanswered_ = 0;                   ///< problems in a row
};

}  // namespace pcrb
