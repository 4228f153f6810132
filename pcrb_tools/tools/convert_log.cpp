#include <iostream>

#include "common/tool_main.hpp"
#include "preparation/preparation.hpp"

namespace pcrb_tools::convert_log {
namespace {

/// What the command line sets.
struct Options {
  OwnRequest request;
  PrepareOptions prepare;
  DatasetParameters parameters;
  double max_gap = 0.25;
};

void addPlaces(CLI::App& app, Options& options) {
  OwnRequest& request = options.request;
  app.add_option("INPUT", request.inputs,
                 "bags of ROS 1, or folders and archives of clouds (pcd, ply, bin, npy)")
      ->required();
  app.add_option("--root", request.root,
                 "root of the common layout: clouds go to ROOT/DATA_SET/SEQUENCE/*.pcd")
      ->required();
  app.add_option("--data-set", request.data_set, "folder of the data set")->capture_default_str();
  app.add_option("--sequence", request.sequence,
                 "folder of the sequence [from the names of the inputs]");
  addChoice(app, "--until", options.prepare.last, prepareStages(), "last stage to run [check]");
}

void addSources(CLI::App& app, Options& options) {
  OwnRequest& request = options.request;
  app.add_option("--cloud-topic", request.cloud_topic,
                 "topic of the clouds [the only one of the bags]");
  app.add_option("--topic", request.pose_topic,
                 "topic of the poses in the bags: PoseStamped, PoseWithCovarianceStamped, "
                 "TransformStamped, Odometry or Path [the only one, or tf]");
  app.add_option("--tf", request.tf, "WORLD BODY: take the poses from tf between these frames")
      ->expected(2);
  app.add_option("--poses", request.poses,
                 "text of poses: tum, kitti, euroc, kaist, log (3DMatch), or csv with names of "
                 "columns [the only one beside the clouds]");
  addPoseFormatOption(app, request.pose_format);
  app.add_option(
      "--times", request.times,
      "text of a timestamp in seconds for each cloud of a folder [times.txt beside them, "
      "or the clouds' names]");
}

void addMeaning(CLI::App& app, Options& options) {
  OwnRequest& request = options.request;
  app.add_flag("--in-world", request.in_world,
               "the clouds are in the world's frame already; poses say where the sensor was");
  app.add_option("--world-frame", request.world_frame,
                 "tf frame that the clouds are wanted in [that of the poses]");
  app.add_option("--body-frame", request.body_frame,
                 "tf frame that the poses are of [that of the messages, else the clouds']");
  addSensorInBodyOption(app, request.T_body_sensor, "from tf");
  app.add_option("--time-offset", request.time_offset,
                 "seconds that are added to the timestamps of the poses")
      ->capture_default_str();
  app.add_option("--max-gap", options.max_gap,
                 "refuse clouds between poses further apart than this, s")
      ->capture_default_str();
  app.add_flag("--deskew", request.deskew,
               "move each point by the pose at its own time (a field time, t, timestamp or "
               "offset_time)");
}

void addSelection(CLI::App& app, Options& options) {
  OwnRequest& request = options.request;
  app.add_option("--min-distance", request.min_distance,
                 "thin to clouds this far from each other, m; 0 = all")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--max-rate", request.max_rate, "thin to this rate, Hz; 0 = all")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag_callback(
      "--drop-origin", [&request] { request.files.origin = pcrb::OriginPoints::kDrop; },
      "leave out points at exactly (0, 0, 0)");
  app.add_option("--bin-fields", request.files.bin_fields,
                 "float32 numbers of a point in a .bin: 4 in KITTI, 5 in nuScenes")
      ->check(CLI::Range(3, 64))
      ->capture_default_str();
  app.add_flag("--force", request.force, "replace clouds that no converter made");
}

void addPreparation(CLI::App& app, Options& options) {
  app.add_option("--overlap-distance", options.parameters.overlap_distance,
                 "for dataset.yaml: distance of points that overlap, m [0.2]")
      ->check(CLI::PositiveNumber);
  app.add_option("--voxel-leaf", options.parameters.voxel_leaf,
                 "for dataset.yaml: edge of the cells of voxel grids, of methods and maps, m [0.2]")
      ->check(CLI::PositiveNumber);
  app.add_option("--sensor", options.parameters.sensor, "for dataset.yaml: words for the report");
  app.add_option("--seed", options.prepare.seed, "seed that the problems are drawn with")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--window", options.prepare.window,
                 "places that a pair may be apart in sequences of more than twice as many clouds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  addThreadsOption(app, options.prepare.threads);
}

/// Puts together what the options say.
void settle(Options& options) {
  options.request.max_gap = pcrb::toStamp(options.max_gap);
  options.request.threads = options.prepare.threads;
  options.prepare.root = options.request.root;
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app(
      "Makes a data set of a log of your own: clouds in one frame, a map, overlaps, problems, and "
      "a check. Run again after a stop, it goes on where it was.");
  app.footer(
      "What is not said is found where it can be one thing only; else the error lists what there "
      "is. Exit status 0 only if the check found no error.\n"
      "Examples: convert_log drive.bag --root ~/pcrb --data-set mine\n"
      "convert_log ~/scans --poses ~/scans/poses.txt --root ~/pcrb --data-set mine");
  Options options;
  addPlaces(app, options);
  addSources(app, options);
  addMeaning(app, options);
  addSelection(app, options);
  addPreparation(app, options);
  return runTool(app, argc, argv, [&options] {
    settle(options);
    return prepareOwn(options.request, options.parameters, options.prepare, std::cout) ? kSuccess
                                                                                       : kFailure;
  });
}

}  // namespace pcrb_tools::convert_log
