#include "bags/bag_tools.hpp"
#include "common/tool_main.hpp"

namespace pcrb_tools::sequence_to_bag {
namespace {

void addFrames(CLI::App& app, SequenceBagOptions& options) {
  app.add_option("--scan-frame", options.sequence.scan_frame,
                 "tf frame of the scans, without truth")
      ->capture_default_str();
  options.sequence.base_frame = "base_link";
  app.add_option("--base-frame", options.sequence.base_frame, "tf frame of the robot's body")
      ->capture_default_str();
  app.add_option("--map-frame", options.sequence.map_frame, "tf frame of the map")
      ->capture_default_str();
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app(
      "Writes a sequence as a bag that `rosbag play --clock` replays for rviz: scans where they "
      "belong, the way of the sensor, a growing map.");
  app.footer(
      "Example: sequence_to_bag ~/pcrb/eth/apartment -o apartment.bag\n"
      "For a node under test: sequence_to_bag ~/pcrb/planetary/p2at_met -o p2at_met.bag \\\n"
      "  --no-truth --map ~/pcrb/planetary/p2at_met/box_map.pcd --scans p2at_met_scans.txt");
  SequenceBagOptions options;
  double rate = 2.0;
  app.add_option("folder", options.sequence.folder, "<root>/<data set>/<sequence>")->required();
  app.add_option("-o,--output", options.bag.output, "bag to write")->required();
  auto* given_rate = app.add_option("--rate", rate, "scans per second")
                         ->check(CLI::Range(1e-3, 1e3))
                         ->capture_default_str();
  app.add_flag("--sensor-rate", options.keeps_time,
               "play scans as far apart as the timestamps in their names")
      ->excludes(given_rate);
  app.add_option("--map", options.sequence.map_file,
                 "file of a map in the sequence's frame [a map that grows]");
  app.add_option("--map-leaf", options.sequence.map_leaf,
                 "edge of the growing map's voxels, m [what the data set says]")
      ->check(CLI::PositiveNumber);
  app.add_option("--map-points", options.sequence.map_points,
                 "number of points of the growing map beyond which its voxels double")
      ->check(CLI::Range(1, 20'000'000))
      ->capture_default_str();
  app.add_option("--exclude", options.sequence.excluded, "names of clouds that are no scans");
  bool no_truth = false;
  app.add_flag("--no-truth", no_truth,
               "only what a node under test may see: the map, then the initial pose, then the "
               "scans in their sensor's frame");
  addFrames(app, options);
  app.add_option("--scans", options.scans,
                 "list to write of which scan has which timestamp, for score_poses");
  app.add_flag("--compress", options.bag.compress, "compress the bag by LZ4");
  app.add_flag("--force", options.bag.force, "replace a bag that this tool did not make");
  return runTool(app, argc, argv, [&] {
    options.bag.period = 1.0 / rate;
    options.sequence.publish_ground_truth = !no_truth;
    runSequenceBagTool(options);
    return kSuccess;
  });
}

}  // namespace pcrb_tools::sequence_to_bag
