#include "common/tool_main.hpp"
#include "pcrb_core/parallel.hpp"
#include "preparation/overlap_tool.hpp"

int main(int argc, char** argv) {
  CLI::App app(
      "Computes the overlap matrix of a sequence: for every ordered pair the fraction of the "
      "source's points with a target point strictly closer than a distance, in ground-truth pose.");
  app.footer(
      "The matrix has the published text format: `overlap name name ...`, a row per source; pairs "
      "that were not asked for are nan. Targets that are done are kept in <output>.partial.\n"
      "Example: compute_overlap ~/pcrb/eth/apartment");
  pcrb_tools::OverlapOptions options;
  options.threads = pcrb::processorCount();
  app.add_option("folder", options.folder, "<root>/<data set>/<sequence>, a folder of .pcd files")
      ->required();
  app.add_option("-o,--output", options.output, "the matrix [<folder>_overlap.txt]");
  app.add_option("--distance", options.distance, "m [the data set's]")->check(CLI::PositiveNumber);
  app.add_option("--window", options.window,
                 "only pairs at most this many places apart; memory then depends on it, not on the "
                 "length of the sequence [0 = all pairs]");
  app.add_option("--target", options.targets, "only these targets, e.g. box_map.pcd [all]");
  app.add_option("--exclude", options.excluded, "clouds to leave out");
  app.add_option("--threads", options.threads)->check(CLI::Range(1, 1024))->capture_default_str();
  app.add_flag("--force", options.force, "replace an output that this tool did not make");
  return pcrb_tools::runTool(app, argc, argv, [&] {
    runOverlapTool(options);
    return pcrb_tools::kSuccess;
  });
}
