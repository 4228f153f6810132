#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <set>
#include <string>

#include "bridge/process_usage.hpp"

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

}  // namespace pcrb
