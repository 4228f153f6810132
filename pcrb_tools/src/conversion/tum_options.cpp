#include "conversion/tum_options.hpp"

#include <vector>

#include "common/tool_main.hpp"
#include "conversion/conversion_main.hpp"

namespace pcrb_tools {

void addTumOptions(CLI::App& app, TumRequest& request) {
  TumOptions& options = request.options;
  app.add_option("--poses", request.poses,
                 "Ground truth (default: …-groundtruth.txt beside the bag, groundtruth.txt in the "
                 "folder or archive)");
  app.add_flag("--nearest", options.nearest,
               "Take the nearest pose, however far in time, as the published clouds did");
  addSecondsOption(app, "--max-gap", options.max_gap,
                   "Refuse clouds between poses further apart than this, s");
  app.add_option("--max-rate", options.max_rate,
                 "Thin to this rate, Hz; 0 = all (default: 0 for clouds of a bag, 2, as the "
                 "published sequences, for depth images)")
      ->check(CLI::NonNegativeNumber);
  addChoice<TumInput>(
      app, "--input", options.input,
      {{"auto", TumInput::kAuto}, {"clouds", TumInput::kClouds}, {"depth", TumInput::kDepth}},
      "Messages of a bag to convert: auto (clouds if there are any), clouds, depth");
  app.add_option_function<std::vector<double>>(
         "--intrinsics",
         [&options](const std::vector<double>& n) {
           options.intrinsics = pcrb::Intrinsics{n[0], n[1], n[2], n[3]};
         },
         "FX FY CX CY in pixels (default: camera_info of a bag; 525 525 319.5 239.5 for PNGs)")
      ->expected(4);
  app.add_option("--depth-units", options.depth_units, "Units of a metre in 16UC1 images of a bag")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag_function(
      "--drop-origin", [&options](auto) { options.origin = pcrb::OriginPoints::kDrop; },
      "Leave out points at exactly (0, 0, 0)");
  app.add_option("--cloud-topic", options.cloud_topic)->capture_default_str();
  app.add_option("--depth-topic", options.depth_topic)->capture_default_str();
  app.add_option("--info-topic", options.info_topic)->capture_default_str();
}

}  // namespace pcrb_tools
