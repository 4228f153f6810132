#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb_tools {

/// Exit statuses of all offline tools.
enum ExitStatus : int {
  kSuccess = 0,
  kFailure = 1,    ///< something is wrong with the data, the disk or the network
  kUsageError = 2  ///< something is wrong with the command line
};

/// Adds an option whose argument is one of some words, each of which stands for a value.
template <typename Choice, typename Value>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Value& value,
                       const std::map<std::string, Choice>& choices,
                       const std::string& description) {
  const auto choose = [&value, choices](const std::string& word) { value = choices.at(word); };
  return app.add_option_function<std::string>(name, choose, description)
      ->check(CLI::IsMember(choices));
}

/// A word of the command line, with the home folder for the ~ that a shell leaves alone in
/// `--run=~/a` and `root:=~/a`.
std::string withHomeFolder(const std::string& word);

/// Adds `--jobs` (`--threads`), by default one per processor.
CLI::Option* addThreadsOption(CLI::App& app, int& threads);

/// Adds `--sensor-in-body x y z qx qy qz qw`.
/// @param otherwise  in the help, what holds without it
CLI::Option* addSensorInBodyOption(CLI::App& app, std::optional<pcrb::Transform>& T_body_sensor,
                                   const std::string& otherwise);

/// Adds `--pose-format`, of a text of poses.
CLI::Option* addPoseFormatOption(CLI::App& app, std::optional<pcrb::PoseFormat>& format);

/// Whether an output is complete and unchanged, which is said on standard error: then a tool has
/// nothing to do.
///
/// @param force  replace an output that is somebody else's.
/// @throws pcrb::InvalidFile  if it is somebody else's, without force.
bool isKept(const pcrb::DerivedFile& output, bool force);

/// Parses the command line and runs a tool: what every offline tool's main ends with.
///
/// Arguments that roslaunch appends (`__name:=…`, remappings) are taken away first, which needs no
/// master; ~ is the home folder; under roslaunch the paths --logs, --root and --run must be
/// absolute; `--help` prints the help and succeeds. An exception becomes one line on standard
/// error, `TOOL: what is wrong`, where TOOL is argv[0] without its folder. A write to a closed pipe
/// ends the process as usual.
///
/// @param app   the tool's options; its description and its footer are the text of `--help`.
/// @param body  the work; what it returns is the exit status.
int runTool(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

}  // namespace pcrb_tools
