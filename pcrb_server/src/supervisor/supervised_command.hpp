#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace pcrb {

/// A command and everything that it starts, ended together.
///
/// roslaunch gives each node a session of its own, so that its process group does not have them:
/// this process becomes the parent of all that its descendants leave behind, and knows them all by
/// that. One per process, and no other children beside it. Use it from one thread: the command gets
/// SIGTERM when that thread ends without stop(), as when this process is killed.
class SupervisedCommand {
 public:
  /// How long stop() waits for what.
  struct Patience {
    std::chrono::milliseconds interrupt{5000};  ///< from SIGINT to SIGTERM
    std::chrono::milliseconds terminate{2000};  ///< from SIGTERM to SIGKILL
  };

  /// @param command  program, looked for in PATH, and arguments.
  explicit SupervisedCommand(std::vector<std::string> command);
  SupervisedCommand(std::vector<std::string> command, Patience patience);
  ~SupervisedCommand();
  SupervisedCommand(const SupervisedCommand&) = delete;
  SupervisedCommand& operator=(const SupervisedCommand&) = delete;

  /// Starts it in a process group of its own, with this process's environment but for
  /// ROS_NAMESPACE.
  /// @throws Error  if it runs already or there can be no process.
  void start();

  /// Whether the command itself runs. What it left behind may run on without it.
  bool isRunning();

  /// Ends all: SIGINT to the command, which passes it on; then SIGTERM, then SIGKILL to everything
  /// that is left. Returns when nothing is.
  void stop();

 private:
  void reap();
  bool waitUntilGone(std::chrono::milliseconds limit);

  std::vector<std::string> command_;
  Patience patience_;
  pid_t pid_ = 0;  ///< 0 when it does not run
};

}  // namespace pcrb
