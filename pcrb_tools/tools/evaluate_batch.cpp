#include "benchmarking/batch_tool.hpp"
#include "benchmarking/series.hpp"
#include "common/tool_main.hpp"
#include "pcrb_core/parallel.hpp"

namespace pcrb_tools::evaluate_batch {

int run(int argc, char** argv) {
  CLI::App app(
      "Runs a benchmark in parallel on this machine: its shards, each with a ROS master of its "
      "own, "
      "then merges their results.");
  app.footer(
      "What is run is a launch file of pcrb_launch with its arguments, name:=value, but for run "
      "and\n"
      "shard, which this tool gives. Started again with the same folder, whatever ended it "
      "before,\n"
      "it goes on. Exit status: 0 only if every problem has its result and every shard's node has\n"
      "answered; else it says which shard and where its log is.\n"
      "Example: evaluate_batch --run ~/pcrb/run --jobs 8 root:=$HOME/pcrb/data method:=gicp");
  BatchOptions options;
  options.jobs = pcrb::processorCount();
  options.arguments = launchArguments(argc, argv);
  app.add_option("--run", options.run, "folder of the results; shards are in its shards/")
      ->required();
  app.add_option("--jobs", options.jobs, "shards at work at the same time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--shards", options.shards,
                 "parts to divide the run into [as before, else --jobs]")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--launch", options.launch, "launch file of pcrb_launch, or a path")
      ->capture_default_str();
  app.add_option("--only", options.only, "run this shard alone, and do not merge: for schedulers")
      ->check(CLI::Range(0, 999999));
  app.add_option_function<std::string>(
         "--master", [&](const std::string& master) { options.own_masters = master == "own"; },
         "ROS master: one of its own per shard, or the one at ROS_MASTER_URI")
      ->check(CLI::IsMember({"own", "current"}))
      ->default_str("own");
  app.add_option("--scratch", options.scratch,
                 "folder for logs and temporary files [logs: with the results]");
  SeriesOptions series;
  app.add_option("--repeat", series.repeat,
                 "number of trials, for what is not deterministic, each a run in trial_<i>")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--sweep", series.sweep,
                 "NAME=V1,V2,…: a run for each value of a parameter of the method");
  return runTool(app, argc, argv, [&] { return runSeriesTool(options, series); });
}

}  // namespace pcrb_tools::evaluate_batch
