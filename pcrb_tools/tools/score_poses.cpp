#include <iostream>
#include <optional>

#include "common/tool_main.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "scoring/scoring_tool.hpp"

namespace pcrb_tools::score_poses {
namespace {

/// What is scored is either a problem file or a sequence.
struct Options {
  ProblemScoringOptions problems;
  TrackingOptions tracking;
  std::string frame = "data_set";
  std::optional<pcrb::Transform> T_body_sensor;
};

void addOffsets(CLI::App& app, CLI::Option* sequence, TrackingOptions& tracking) {
  app.add_option("--time-offset", tracking.time_offset,
                 "seconds that are added to the timestamps of the poses")
      ->needs(sequence)
      ->capture_default_str();
  app.add_option("--estimate-offset", tracking.largest_offset,
                 "estimate a time offset, at most so many seconds; 0 = do not")
      ->check(CLI::NonNegativeNumber)
      ->needs(sequence)
      ->capture_default_str();
}

void addTrackingOptions(CLI::App& app, CLI::Option* sequence, Options& options) {
  auto& tracking = options.tracking;
  app.add_option("--output", tracking.output, "folder of the results of a sequence")
      ->needs(sequence);
  app.add_option("--scans", tracking.scans,
                 "list that sequence_to_bag or replay wrote [timestamps are in the clouds' names, "
                 "poses in the clouds' frame]")
      ->needs(sequence);
  app.add_option("--max-difference", tracking.max_difference,
                 "largest time between a scan and its pose, s")
      ->check(CLI::NonNegativeNumber)
      ->needs(sequence)
      ->capture_default_str();
  app.add_option("--delta", tracking.delta, "number of scans over which relative errors are taken")
      ->check(CLI::PositiveNumber)
      ->needs(sequence)
      ->capture_default_str();
  app.add_option("--metres", tracking.metres,
                 "length of path over which further relative errors are taken, m")
      ->check(CLI::PositiveNumber)
      ->needs(sequence)
      ->capture_default_str();
  app.add_option(
         "--max-lost", tracking.max_lost,
         "fraction of the scans that may be lost, without a pose; more, and the exit status is 1")
      ->check(CLI::Range(0.0, 1.0))
      ->needs(sequence)
      ->capture_default_str();
  app.add_flag("--align", tracking.align, "align the trajectory rigidly before the absolute errors")
      ->needs(sequence);
  addSensorInBodyOption(app, options.T_body_sensor, "the poses are the sensor's")->needs(sequence);
  addPoseFormatOption(app, options.problems.poses.format)->needs(sequence);
  app.add_option("--tf", tracking.tf, "WORLD BODY: take the poses from tf between these frames")
      ->expected(2)
      ->needs(sequence);
  addOffsets(app, sequence, tracking);
}

void addOptions(CLI::App& app, Options& options) {
  auto& problems = options.problems;
  auto* file = app.add_option("problem_file", problems.problem_file,
                              "<root>/<data set>/<sequence>_local.txt or _global.txt");
  auto* sequence = app.add_option("--sequence", options.tracking.folder,
                                  "<root>/<data set>/<sequence>: score a trajectory instead");
  sequence->excludes(file);
  app.add_option("--poses", problems.poses.path,
                 "a bag, or a text of rows `id` and the first three rows of a 4 x 4 matrix, or "
                 "`timestamp tx ty tz qx qy qz qw`; of a sequence also kitti, euroc, kaist, log "
                 "(3DMatch), or csv with names of columns")
      ->required();
  app.add_option("--topic", problems.poses.topic, "topic of the poses in the bag");
  app.add_option("--map-frame", problems.poses.map_frame, "tf frame of the poses in the bag")
      ->capture_default_str();
  auto* run = app.add_option("--run", problems.run, "folder of the results of problems");
  run->needs(file);
  app.add_option("--key", problems.key, "key that problems_to_bag wrote with the bag")->needs(file);
  app.add_option("--frame", options.frame,
                 "frame of the poses, without a key: data_set (that of the clouds' files) or map "
                 "(that in which the server publishes clouds; the same unless coordinates are "
                 "large)")
      ->check(CLI::IsMember({"data_set", "map"}))
      ->needs(file)
      ->capture_default_str();
  app.add_option("--subset", problems.subset,
                 "number of problems that were drawn, without a key; 0 = all")
      ->needs(file);
  app.add_option("--seed", problems.seed, "seed of that draw, without a key")->needs(file);
  addTrackingOptions(app, sequence, options);
}

int score(Options& options) {
  if (!options.problems.problem_file.empty()) {
    if (options.problems.run.empty()) throw pcrb::InvalidParameter("--run: must be given");
    options.problems.pose_frame =
        options.frame == "data_set" ? pcrb::PoseFrame::kDataset : pcrb::PoseFrame::kMap;
    runProblemScoring(options.problems, std::cout);
    return kSuccess;
  }
  if (options.tracking.folder.empty() || options.tracking.output.empty()) {
    throw pcrb::InvalidParameter(
        "expected a problem file and --run, or --sequence and --output (see --help)");
  }
  options.tracking.poses = options.problems.poses;
  options.tracking.T_body_sensor = options.T_body_sensor.value_or(pcrb::Transform::Identity());
  if (runTrackingScoring(options.tracking, std::cout)) return kSuccess;
  std::cerr << "score_poses: more scans were lost than --max-lost "
            << pcrb::formatShortest(options.tracking.max_lost) << " allows" << std::endl;
  return kFailure;
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app(
      "Scores poses offline: of registration problems, into a run like the server's, or of a "
      "sequence's scans, with the field's errors of trajectories.");
  app.footer(
      "Examples: score_poses ~/pcrb/eth/apartment_local.txt --poses mine.txt --run ~/runs/mine\n"
      "score_poses ~/pcrb/eth/apartment_local.txt --key problems.key --poses answers.bag \\\n"
      "  --topic /pose --run ~/runs/mine\n"
      "score_poses --sequence ~/pcrb/tum/pioneer_slam --poses est.tum --output ~/runs/tracking");
  Options options;
  addOptions(app, options);
  return runTool(app, argc, argv, [&options] { return score(options); });
}

}  // namespace pcrb_tools::score_poses
