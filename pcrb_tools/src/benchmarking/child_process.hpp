#pragma once

#include <sys/types.h>

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

}  // namespace pcrb_tools
