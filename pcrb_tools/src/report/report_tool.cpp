#include "pcrb_tools/report/report_tool.hpp"

#include <ros/package.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstring>
#include <vector>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kPython = "/usr/bin/python3";

/// Runs a program with the environment of this one; returns its exit status, 128 + n for signal n.
int runProgram(std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  const int failure = posix_spawn(&child, pointers[0], nullptr, nullptr, pointers.data(), environ);
  if (failure != 0) {
    throw pcrb::Error(arguments[0] + ": cannot be started: " + std::strerror(failure));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw pcrb::Error(arguments[0] + ": lost: " + std::strerror(errno));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

void runReportTool(const ReportOptions& options) {
  writeReportData(options);
  const std::string script = ros::package::getPath("pcrb_tools") + "/report/draw_report.py";
  std::vector<std::string> command{kPython, "-B", script, options.output};
  if (!options.draw_figures) command.emplace_back("--no-figures");
  const int status = runProgram(command);
  if (status != 0) {
    throw pcrb::Error("drawing " + options.output + " failed with status " +
                      std::to_string(status) + " (see above); what was computed is there");
  }
}

}  // namespace pcrb_tools
