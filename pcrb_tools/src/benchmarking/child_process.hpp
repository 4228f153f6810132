#pragma once

#include <sys/types.h>

#include <set>

#include "pcrb_server/processes.hpp"

namespace pcrb_tools {

/// A program in a process group of its own, until it has ended.
class ChildProcess {
 public:
  /// @throws pcrb::Error  as pcrb::startProgram().
  explicit ChildProcess(const pcrb::ProgramStart& start);

  /// Kills it if it is still there; stop it before.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Whether it has ended; does not wait.
  bool ended();

  /// Sends a signal to the process alone, which tells its own children; none if it has ended.
  void signal(int number);

  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
  bool ended_ = false;
};

/// From now on this process is the parent of what its descendants leave behind when they end.
void becomeSubreaper();

/// Ends all processes below this one: SIGTERM, and SIGKILL to those that do not heed it for 5 s.
/// Returns when none is left.
/// @param spared  processes that go on, with all below them.
void endDescendants(const std::set<pid_t>& spared);

/// A TCP port of the loopback interface that the system gives to no other process that asks for any
/// free port, as long as this object lives. A program that binds it by its number with
/// SO_REUSEADDR, as ROS masters do, gets it.
class ReservedPort {
 public:
  /// @throws pcrb::Error  if no port is free.
  ReservedPort();
  ~ReservedPort();
  ReservedPort(const ReservedPort&) = delete;
  ReservedPort& operator=(const ReservedPort&) = delete;

  int number() const { return number_; }

 private:
  int socket_ = -1;
  int number_ = 0;
};

}  // namespace pcrb_tools
