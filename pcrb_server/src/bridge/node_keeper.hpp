#pragma once

#include <ros/node_handle.h>

#include <map>
#include <optional>
#include <string>

#include "bridge/bridge_parameters.hpp"
#include "bridge/node_inputs.hpp"
#include "bridge/node_processes.hpp"

namespace pcrb {

/// Watches over the node under test: whether it is there, died, hangs, what it uses; asks
/// `node_supervisor` for a new one.
///
/// A node is back when it takes scans again after it had left.
class NodeKeeper {
 public:
  NodeKeeper(ros::NodeHandle& node, const BridgeParameters& parameters, const NodeInputs& inputs);

  /// Call at the start of each problem.
  /// @param is_new_target  whether the problem's target is another one than that before.
  void beginProblem(bool is_new_target);

  /// Whether the node has to be restarted before the problem.
  bool needsRestart() const { return needs_restart_; }

  /// Asks the supervisor for a restart, which ends the node first; false, saying why, if nobody
  /// answers or the supervisor cannot.
  bool restart();

  /// Whether the node that was asked for is there.
  bool isThere() const;

  /// Call when the node is there: from now on it has the problem.
  void beginWatch();

  /// Whether the node has left since beginWatch().
  bool hasLeft() const;

  /// Call before the first scan of each problem.
  void beginPlay();

  /// Call after each problem.
  /// @param is_answered  whether the node said anything about its scans.
  void endProblem(bool is_answered);

  /// What the node has used since beginPlay(), if its processes are on this machine.
  std::optional<ProcessUsage> usage();

  /// Counts the nodes that came and went: another number, another node.
  int generation() const;

 private:
  bool isHanging() const;

  const BridgeParameters& parameters_;
  const NodeInputs& inputs_;
  ros::NodeHandle& node_;
  NodeProcesses processes_;
  bool needs_restart_ = false;
  std::map<std::string, int> before_;    ///< departures of the nodes to be gone before a new one
  std::map<std::string, int> at_start_;  ///< departures of the nodes that have the problem
  int unanswered_ = 0;                   ///< problems in a row
};

}  // namespace pcrb
