#include "conversion/kaist_options.hpp"

#include <vector>

#include "conversion/conversion_main.hpp"

namespace pcrb_tools {

void addKaistOptions(CLI::App& app, KaistRequest& request) {
  pcrb::KaistOptions& options = request.options;
  app.add_option("--poses", request.poses, "global_pose.csv (default: the one in the log)");
  app.add_option("--left-calibration", request.left_calibration,
                 "Vehicle2LeftVLP.txt (default: the one in the log)");
  app.add_option("--right-calibration", request.right_calibration,
                 "Vehicle2RightVLP.txt (default: the one in the log)");
  app.add_flag("--interpolate", options.interpolate,
               "Interpolate between the poses around a scan instead of taking the closest one");
  addSecondsOption(app, "--max-pose-gap", options.max_pose_gap,
                   "Refuse scans farther from a pose (or between poses farther apart), s");
  addSecondsOption(app, "--max-pair-gap", options.max_pair_gap,
                   "Refuse left scans without a right one this close in time, s");
  app.add_option_function<std::vector<double>>(
         "--frame-offset",
         [&options](const std::vector<double>& n) {
           options.frame_offset = {n[0], n[1], n[2]};
         },
         "X Y Z in m, added to UTM: what check_dataset says of the published problem files")
      ->expected(3);
  app.add_option("--max-rate", request.max_rate, "Thin to this rate, Hz; 0 = all scans")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag_function(
      "--keep-origin", [&request](auto) { request.origin = pcrb::OriginPoints::kKeep; },
      "Keep points at exactly (0, 0, 0), which are no returns");
  app.add_option("--left-topic", request.left_topic, "Of a bag")->capture_default_str();
  app.add_option("--right-topic", request.right_topic, "Of a bag")->capture_default_str();
}

}  // namespace pcrb_tools
