#include <iostream>

#include "common/tool_main.hpp"
#include "ground_truth/ground_truth_tool.hpp"
#include "pcrb_core/parallel.hpp"

namespace pcrb_tools::evaluate_ground_truth {

int run(int argc, char** argv) {
  CLI::App app(
      "Evaluates the ground truth of data sets: registers each pair of a problem file from its "
      "ground-truth pose and measures how far that moves the source.");
  app.footer(
      "Writes pairs/*.csv, ground_truth.csv, .txt, .svg and ground_truth_pairs.svg. The accuracy "
      "of a sequence is the "
      "floor below which methods cannot be told apart on it: give the CSV to report "
      "--ground-truth.\n"
      "Example: evaluate_ground_truth ~/pcrb --output ground_truth --sequences eth/apartment");
  GroundTruthOptions options;
  options.threads = pcrb::processorCount();
  std::string kind = "local";
  app.add_option("root", options.root, "folder of data sets in the common layout");
  app.add_option("-o,--output", options.output, "folder to write to")->required();
  app.add_option("--sequences", options.sequences,
                 "sequences, data sets or data_set/sequence [all]");
  app.add_option("--kind", kind, "kind of the problem files whose pairs are taken [local]")
      ->check(CLI::IsMember({"local", "global"}));
  app.add_option("--distance,--radius", options.radius,
                 "distance beyond which points are no pair, m [the data set's overlap distance]")
      ->check(CLI::PositiveNumber);
  app.add_option("--pairs", options.max_pairs,
                 "number of pairs per sequence, evenly over its problem file [0 = all]");
  app.add_option(
      "--import", options.imports,
      "files of misalignments instead, <data set>=<path>/<sequence>.csv, or the published "
      "<data set>=<path>/<sequence>_gt_check.dat");
  app.add_option("--jobs,--threads", options.threads,
                 "number of threads, which does not change the result")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--force", options.force, "replace files that this tool did not make");
  return runTool(app, argc, argv, [&] {
    options.kind = pcrb::kindFromString(kind);
    runGroundTruthTool(options, std::cout);
    return kSuccess;
  });
}

}  // namespace pcrb_tools::evaluate_ground_truth
