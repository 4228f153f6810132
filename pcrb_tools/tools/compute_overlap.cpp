#include "common/tool_main.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools::compute_overlap {

int run(int argc, char** argv) {
  CLI::App app(
      "Computes the overlap matrix of a sequence: for every ordered pair the fraction of the "
      "source's points with a target point strictly closer than a distance, in ground-truth pose.");
  app.footer(
      "The matrix has the published text format: `overlap name name ...`, a row per source; pairs "
      "that were not asked for are nan. Targets that are done are kept in <output>.partial.\n"
      "Example: compute_overlap ~/pcrb/eth/apartment");
  OverlapOptions options;
  app.add_option("folder", options.folder, "<root>/<data set>/<sequence>, a folder of .pcd files")
      ->required();
  app.add_option("-o,--output", options.output, "file of the matrix [<folder>_overlap.txt]");
  app.add_option("--distance", options.distance,
                 "largest distance of points that overlap, m [the data set's]")
      ->check(CLI::PositiveNumber);
  app.add_option(
      "--window", options.window,
      "compute only pairs at most this many places apart, with memory that depends on it and "
      "not on the length of the sequence [0 = all pairs]");
  app.add_option("--target", options.targets,
                 "names of the targets to compute, e.g. box_map.pcd [all]");
  app.add_option("--exclude", options.excluded, "names of clouds to leave out of the matrix");
  addThreadsOption(app, options.threads);
  app.add_flag("--force", options.force, "replace an output that this tool did not make");
  return runTool(app, argc, argv, [&] {
    runOverlapTool(options);
    return kSuccess;
  });
}

}  // namespace pcrb_tools::compute_overlap
