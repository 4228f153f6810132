#include "pcrb_core/run/merge_runs.hpp"

#include <iostream>

#include "common/tool_main.hpp"

namespace pcrb_tools::merge_runs {

int run(int argc, char** argv) {
  CLI::App app("Merges the shards of a run into one run, and prints its summary.");
  app.footer(
      "The shards must be parts 0/N ... (N-1)/N of one run, each once, all of one configuration,\n"
      "and every problem must have its result. The shards are only read.\n"
      "Exit status: 0 only if every shard's node has answered; all is written before that is "
      "said.\n"
      "Example: merge_runs ~/pcrb/run/shards/* -o ~/pcrb/run");
  pcrb::MergeOptions options;
  app.add_option("shards", options.runs, "folders of the shards' results")->required();
  app.add_option("-o,--output", options.output, "folder of the merged run")->required();
  return runTool(app, argc, argv, [&] {
    const pcrb::MergeReport report = mergeRuns(options);
    std::cout << report.summary << std::flush;
    std::cerr << report.defects << std::flush;
    return report.defects.empty() ? kSuccess : kFailure;
  });
}

}  // namespace pcrb_tools::merge_runs
