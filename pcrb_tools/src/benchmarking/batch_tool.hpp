#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pcrb_tools {

/// What `evaluate_batch` is asked for.
struct BatchOptions {
  std::string run;                          ///< folder of the whole run
  std::string launch = "benchmark.launch";  ///< of package pcrb_launch, or a path
  std::vector<std::string> arguments;       ///< of the launch file, `name:=value`
  int jobs = 1;                             ///< shards at work at the same time
  int shards = 0;                           ///< 0: as before, or as many as jobs
  std::optional<int> only;                  ///< this shard alone, and no merging
  std::string scratch;                      ///< folder for logs and temporary files
};

/// The arguments of a launch file among a program's: `name:=value`, but for `__name:=…` and its
/// like, which roslaunch appends.
std::vector<std::string> launchArguments(int argc, char** argv);

/// Runs the shards of a benchmark run, each in `<run>/shards/<i>` with a master of its own on the
/// loopback interface, then merges them into `<run>` and prints the summary.
///
/// Shards that are complete are kept. SIGINT and SIGTERM end all in order; whatever ended a run,
/// the next one goes on.
/// @return  exit status: not 0 if a problem has no result, or no problem of a shard was answered.
/// @throws pcrb::Error  if the folder holds a run of another configuration (naming every
///                      difference), or the shards cannot be merged.
int runBatchTool(const BatchOptions& options);

}  // namespace pcrb_tools
