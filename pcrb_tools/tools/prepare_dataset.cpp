#include <iostream>

#include "common/tool_main.hpp"
#include "pcrb_core/parallel.hpp"
#include "preparation/preparation.hpp"

namespace pcrb_tools::prepare_dataset {
namespace {

void addSelection(CLI::App& app, PrepareOptions& options) {
  app.add_option(
      "sequences", options.sequences,
      "sequences to prepare: names of sequences, data sets, or <data set>/<sequence> [all]");
  app.add_option("--logs", options.logs, "folder of the original logs")->required();
  app.add_option("--root", options.root, "root of the common layout")->required();
  addChoice(app, "--until", options.last, prepareStages(), "last stage to run [check]");
}

void addParameters(CLI::App& app, PrepareOptions& options) {
  app.add_option("--seed", options.seed, "seed that the problems are drawn with")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  addChoice<pcrb::BoundsSource>(
      app, "--bounds", options.bounds,
      {{"measured", pcrb::BoundsSource::kMeasured}, {"note", pcrb::BoundsSource::kNote}},
      "bounds of the perturbations: measured in the published problem files, or of upstream's note "
      "[measured]");
  app.add_option("--kaist-max-rate", options.kaist_max_rate,
                 "rate that KAIST's scans are thinned to, Hz; 0 = all scans")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--window", options.window,
                 "places that a pair may be apart in sequences of more than twice as many clouds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--overlap-pairs", options.overlap_pairs,
                 "number of pairs of each problem file whose overlap the check recomputes")
      ->capture_default_str();
  options.threads = pcrb::processorCount();
  app.add_option("-j,--jobs,--threads", options.threads,
                 "number of threads, which does not change the result")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app(
      "Prepares data sets from their original logs, in stages: convert, map, overlap, problems, "
      "check. Run again after a stop, it goes on where it was.");
  app.footer(
      "LOGS has folders eth, planetary, tum and kaist (or some of them) with the logs as "
      "fetch_datasets and make_sample_logs put them. Exit status 0 only if the check found no "
      "error.\n"
      "Example: prepare_dataset --logs ~/logs --root ~/benchmark eth/apartment kaist");
  PrepareOptions options;
  addSelection(app, options);
  addParameters(app, options);
  return runTool(app, argc, argv,
                 [&options] { return prepareDataset(options, std::cout) ? kSuccess : kFailure; });
}

}  // namespace pcrb_tools::prepare_dataset
