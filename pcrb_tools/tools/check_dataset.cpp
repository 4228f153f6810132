#include <iostream>

#include "common/tool_main.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools::check_dataset {

int run(int argc, char** argv) {
  CLI::App app(
      "Checks data sets in the common layout: every cloud readable, the clouds of every problem "
      "present and in its frame, no duplicates, overlaps recomputed on a sample.");
  app.footer(
      "One line per finding on standard output; exit status 1 if one is an error. If a problem "
      "file "
      "was made with clouds in another frame, the offset that would explain it is estimated.\n"
      "Example: check_dataset ~/pcrb eth/apartment kaist");
  CheckOptions options;
  app.add_option("root", options.root, "folder of the data sets")->required();
  app.add_option(
      "sequences", options.sequences,
      "sequences to check: names of sequences, data sets, or <data set>/<sequence> [all]");
  app.add_option("--overlap-pairs", options.overlap_pairs,
                 "number of pairs of each problem file whose overlap is recomputed")
      ->capture_default_str();
  app.add_flag("--strict", options.strict, "exit with 1 for warnings too");
  addThreadsOption(app, options.threads);
  return runTool(app, argc, argv,
                 [&] { return runCheckTool(options, std::cout) ? kSuccess : kFailure; });
}

}  // namespace pcrb_tools::check_dataset
