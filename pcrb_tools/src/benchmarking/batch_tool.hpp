#pragma once

#include <functional>
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
  bool own_masters = true;                  ///< else all nodes are at ROS_MASTER_URI
};

/// The arguments of a launch file among a program's: `name:=value`, but for `__name:=…` and its
/// like, which roslaunch appends.
std::vector<std::string> launchArguments(int argc, char** argv);

/// Runs the shards of a benchmark run, each in `<run>/shards/<i>` with a master of its own on the
/// loopback interface unless that is not wanted, then merges them into `<run>` and prints the
/// summary.
///
/// Shards that are complete are kept. SIGINT and SIGTERM end all in order; whatever ended a run,
/// the next one goes on.
/// @return  exit status: not 0 if a problem has no result, or no problem of a shard was answered.
/// @throws pcrb::Error  if the folder holds a run of another configuration (naming every
///                      difference), or the shards cannot be merged.
int runBatchTool(const BatchOptions& options);

/// The number of shards of a batch: as asked for, else as noted in its folder, else as many as
/// jobs.
/// @throws pcrb::Error  if the note in the folder is of something else.
int numberOfShards(const BatchOptions& options);

/// Notes in `<run>/batch.txt` what is run, if nothing is noted there or no problem has a result, so
/// that no other program can go on with it.
/// @throws pcrb::Error  if something else is noted, naming every difference.
void noteConfiguration(const BatchOptions& options, int shards);

/// roslaunch itself takes an argument that no launch file declares for none, without a word.
/// @throws pcrb::InvalidParameter  if there is such an argument, naming those that are known.
void requireKnownArguments(const BatchOptions& options);

/// roslaunch and its arguments, but for `run` and `shard`.
/// @throws pcrb::InvalidParameter  if those or a wrong `root` are among the arguments.
std::vector<std::string> launchCommand(const BatchOptions& options);

/// What `run_paper` is asked for.
struct PaperOptions {
  std::string root;                  ///< folder of the data sets
  std::string run;                   ///< folder of the runs, one below it per method
  std::vector<std::string> methods;  ///< to run; empty = all of the paper
  std::string plugin;                ///< library of the methods that are not the paper's
  std::string parameters;            ///< parameter file of those methods
  std::string client;                ///< command that starts a client, in place of a plugin
  std::string kind = "local";        ///< kind of the problems that those methods are given
  std::vector<std::string> sequences{"all"};
  int subset = 0;            ///< number of problems per method, 0 = all
  int seed = 1;              ///< of the subset
  double time_limit = 30.0;  ///< s per problem
  int jobs = 1;              ///< benchmarks at the same time; they disturb each other's runtimes
  /// Writes the report of runs into a folder.
  std::function<void(const std::vector<std::string>& runs, const std::string& output)> write_report;
};

/// Methods of the paper: icp, gicp, ndt, ppcr (local problems), ransac, fgr, teaser (global ones).
std::vector<std::string> paperMethods();

/// Runs the paper's experiments, each method in `<run>/<method>`, then writes `<run>/report`.
///
/// What is complete is kept, what was interrupted goes on. A method that fails does not keep the
/// others from running; the report is of all that are complete, those of earlier calls too.
/// @return  exit status: 0 only if every problem of every method has its result and was reported.
/// A method that is not the paper's is the plugin's or the client's; with a client and no such
/// method it is called `client`.
/// @throws pcrb::Error  if a method is neither the paper's nor can be the user's, a folder holds a
///                      run of another configuration, or nothing is complete.
int runPaperTool(const PaperOptions& options);

}  // namespace pcrb_tools
