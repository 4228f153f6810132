#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "pcrb_server/parameter_table.hpp"

namespace pcrb {

/// Tells a node's work that it has to end: SIGINT, SIGTERM or a shutdown by the master.
class ShutdownRequest {
 public:
  /// Calls back, from another thread and at once if the request came already. One callback at a
  /// time.
  void onShutdown(std::function<void()> callback);

  /// The callback is not called any more when this returns.
  void forget();

  bool requested() const;

 private:
  friend class ShutdownWatcher;
  void make();

  mutable std::mutex mutex_;
  bool requested_ = false;
  std::function<void()> callback_;
};

/// What `NODE --help` prints.
struct NodeHelp {
  std::string name;
  std::string description;
  std::string details;  ///< topics, services, examples
  ParameterTable parameters = {};
};

/// Runs a node: what every node's main ends with.
///
/// `--help` needs no master; other arguments but ROS's own are refused. A node started without a
/// namespace runs in `/pcrb`. A missing master, and `use_sim_time` without `/clock` for 5 s, are
/// errors. Signals end the node in order through the request; a second one ends it at once. An
/// exception becomes one message on standard error, not on /rosout, where a client could read it.
///
/// @param body  the node's work; what it returns is the exit status.
int runNode(int argc, char** argv, const NodeHelp& help,
            const std::function<int(ShutdownRequest&)>& body);

}  // namespace pcrb
