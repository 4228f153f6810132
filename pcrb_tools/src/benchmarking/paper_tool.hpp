#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pcrb_tools {

/// What `run_paper` is asked for.
struct PaperOptions {
  std::string root;                  ///< folder of the data sets
  std::string run;                   ///< folder of the runs, one below it per method
  std::vector<std::string> methods;  ///< to run; empty = all of the paper
  std::string sequences = "all";
  int subset = 0;            ///< number of problems per method, 0 = all
  int seed = 1;              ///< of the subset
  double time_limit = 60.0;  ///< s per problem
  int jobs = 1;              ///< benchmarks at the same time; latencies are true with one only
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
/// @throws pcrb::Error  if a folder holds a run of another configuration, or nothing is complete.
int runPaperTool(const PaperOptions& options);

}  // namespace pcrb_tools
