#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pcrb_tools {

/// How a program is started.
struct ChildOptions {
  std::vector<std::string> command;  ///< looked up in PATH
  /// Changes to this process's environment; nothing: the variable is taken away.
  std::map<std::string, std::optional<std::string>> environment;
  std::string log;                ///< file that standard output and error are appended to
  int inherited_descriptor = -1;  ///< open in the child, too, under the same number
};

/// A program in a process group of its own, so that a terminal's Ctrl-C reaches it only through
/// its parent. It gets SIGTERM if its parent dies first.
class ChildProcess {
 public:
  /// @throws pcrb::Error  if the log cannot be opened or no process can be made. A program that is
  ///                      not found ends with status 127.
  explicit ChildProcess(const ChildOptions& options);

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
  pid_t pid_ = -1;
  bool ended_ = false;
};

}  // namespace pcrb_tools
