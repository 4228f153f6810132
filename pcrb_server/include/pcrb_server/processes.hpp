#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

/// Processes of this machine: started, found and measured.
namespace pcrb {

/// How a program is started.
struct ProgramStart {
  std::vector<std::string> command;  ///< looked up in PATH
  /// Changes to this process's environment; nothing: the variable is taken away.
  std::map<std::string, std::optional<std::string>> environment;
  std::string log;  ///< file that standard output and error are appended to, with no standard
                    ///< input; empty: this process's streams
  int inherited_descriptor = -1;  ///< open in the program, too, under the same number
};

/// Starts a program in a process group of its own, so that a terminal's Ctrl-C reaches it only
/// through its parent. It gets SIGTERM when the calling thread ends, as when this process is
/// killed.
///
/// @return  its process. A program that cannot be run says so on its standard error and ends with
///          status 127, as in a shell.
/// @throws InvalidFile  if the log cannot be opened.
/// @throws Error        if there can be no process.
pid_t startProgram(const ProgramStart& start);

/// Processes on this machine that descend from one, those that have ended but were not waited for
/// included.
///
/// @param root      is not among them.
/// @param excluded  neither are these, nor what descends from them.
std::vector<pid_t> processesBelow(pid_t root, const std::set<pid_t>& excluded = {});

/// What a process has used so far.
struct ProcessUsage {
  double cpu_time = 0.0;          ///< s, user and system, of all its threads
  std::uint64_t peak_memory = 0;  ///< bytes, greatest resident set
};

/// @return  nothing if there is no such process, or it cannot be looked at.
std::optional<ProcessUsage> usageOf(pid_t pid);

}  // namespace pcrb
