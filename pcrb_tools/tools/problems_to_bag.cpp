#include "bags/bag_tools.hpp"
#include "common/tool_main.hpp"

namespace pcrb_tools::problems_to_bag {
namespace {

void addProblemOptions(CLI::App& app, ProblemsBagOptions& options, std::string& presentation) {
  app.add_option("problem_file", options.problem_file,
                 "<root>/<data set>/<sequence>_local.txt or _global.txt")
      ->required();
  app.add_option("-o,--output", options.bag.output, "bag to write")->required();
  app.add_option("--period", options.bag.period, "time from a problem to the next, s")
      ->check(CLI::Range(1e-3, 1e4))
      ->capture_default_str();
  app.add_option("--presentation", presentation,
                 "how problems are shown: two clouds, or a map and a scan in its sensor's frame")
      ->check(CLI::IsMember({"registration", "localization"}))
      ->capture_default_str();
  app.add_flag("--yaw-only,--upright", options.problems.configuration.presentation.yaw_only,
               "localization without VIEWPOINT: turn scans about z only; gives the tilt away");
  app.add_option("--subset", options.problems.configuration.selection.subset,
                 "number of problems to draw; 0 = all")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--seed", options.problems.configuration.selection.seed, "seed of the subset")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app(
      "Writes registration problems as a bag that `rosbag play --clock` replays: for rviz, or "
      "without truth for whoever is to solve them.");
  app.footer(
      "Example: problems_to_bag ~/pcrb/eth/apartment_local.txt -o apartment.bag --subset 50\n"
      "Given away: problems_to_bag ~/pcrb/eth/apartment_local.txt -o problems.bag --no-truth \\\n"
      "  --key problems.key, and later score_poses … --key problems.key");
  ProblemsBagOptions options;
  options.bag.period = 2.0;
  bool no_truth = false;
  std::string presentation = "registration";
  addProblemOptions(app, options, presentation);
  app.add_flag("--no-truth", no_truth,
               "what a client of the server would see, in a secret order, with random ids");
  app.add_option("--key", options.key, "file for the key with which score_poses scores");
  app.add_option("--scan-frame", options.problems.scan_frame,
                 "tf frame of the source, in localization")
      ->capture_default_str();
  app.add_option("--map-frame", options.problems.map_frame, "tf frame of the map")
      ->capture_default_str();
  app.add_flag("--compress", options.bag.compress, "compress the bag by LZ4");
  app.add_flag("--force", options.bag.force, "replace a bag that this tool did not make");
  return runTool(app, argc, argv, [&] {
    options.problems.publish_ground_truth = !no_truth;
    options.problems.configuration.presentation.kind = pcrb::presentationFromString(presentation);
    runProblemsBagTool(options);
    return kSuccess;
  });
}

}  // namespace pcrb_tools::problems_to_bag
