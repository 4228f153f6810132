#include <vector>

#include "common/tool_main.hpp"
#include "conversion/live_node.hpp"
#include "conversion/live_run.hpp"
#include "conversion/tum_stream.hpp"
#include "pcrb_core/io/file_bytes.hpp"

namespace pcrb_tools {
namespace {

const pcrb::NodeHelp kHelp{
    "tum_to_pcd",
    "Converts a TUM RGB-D sequence while it is published, to the same files as offline.",
    std::string("Private parameters (default):") + kLiveParametersHelp + R"(
  poses             ground-truth file (required)
  input (clouds)    clouds, or depth: depth images and camera_info
  nearest (false)   take the nearest pose, however far in time
  max_gap (0.1)     refuse clouds between poses further apart than this, s
  max_rate          thin to this rate, Hz; 0 = all (clouds: 0, depth: 2)
  intrinsics        "fx fy cx cy" in pixels (camera_info)
  depth_units (1000)  units of a metre in 16UC1 images
  drop_origin (false) leave out points at exactly (0, 0, 0)
  cloud_topic (/camera/rgb/points), depth_topic (/camera/depth/image),
  info_topic (/camera/rgb/camera_info)

Ends when it is interrupted, or by ~idle_limit, with a report. Example:
  rosrun pcrb_tools tum_to_pcd --live _root:=$HOME/benchmark _sequence:=pioneer_slam \
    _poses:=$HOME/logs/rgbd_dataset_freiburg2_pioneer_slam-groundtruth.txt)"};

struct LiveTumRequest {
  TumRequest conversion;
  LiveOptions live;
};

LiveTumRequest readRequest() {
  LiveTumRequest result;
  TumRequest& request = result.conversion;
  TumOptions& options = request.options;
  pcrb::NodeParameters parameters;
  result.live = readLiveParameters(parameters, request);
  request.poses = parameters.requiredString("poses");
  options.input = parameters.choice("input", "clouds", {"clouds", "depth"}) == "depth"
                      ? TumInput::kDepth
                      : TumInput::kClouds;
  options.nearest = parameters.boolean("nearest", false);
  options.max_gap = pcrb::toStamp(parameters.number("max_gap", 0.1, 0.0, 1e6));
  options.max_rate = parameters.number("max_rate", maxRate(options, options.input), 0.0, 1e6);
  const auto camera = readNumbers(parameters, "intrinsics", 4);
  if (!camera.empty()) options.intrinsics = {camera[0], camera[1], camera[2], camera[3]};
  options.depth_units = parameters.number("depth_units", 1000.0, 1e-6, 1e6);
  if (parameters.boolean("drop_origin", false)) options.origin = pcrb::OriginPoints::kDrop;
  options.cloud_topic = parameters.string("cloud_topic", options.cloud_topic);
  options.depth_topic = parameters.string("depth_topic", options.depth_topic);
  options.info_topic = parameters.string("info_topic", options.info_topic);
  parameters.finish();
  return result;
}

void subscribe(const TumOptions& options, TumStream& stream, LiveInput& input) {
  if (options.input == TumInput::kClouds) {
    input.subscribe<sensor_msgs::PointCloud2>(
        options.cloud_topic, [&stream](const auto& cloud) { stream.addCloud(cloud); });
    return;
  }
  input.subscribe<sensor_msgs::Image>(options.depth_topic,
                                      [&stream](const auto& image) { stream.addDepth(image); });
  if (options.intrinsics) return;
  input.subscribe<sensor_msgs::CameraInfo>(
      options.info_topic, [&stream](const auto& info) { stream.setCamera(*info); });
}

int run(pcrb::ShutdownRequest& shutdown) {
  const auto [request, live] = readRequest();
  const pcrb::Trajectory trajectory =
      pcrb::parseTumTrajectory(pcrb::FileBytes(request.poses).text(), request.poses);
  Conversion conversion(request, request.sequence, 0);
  noteTrajectory(trajectory, conversion);
  TumStream stream(trajectory, request.options, request.options.input, "live ", conversion);
  LiveInput input;
  subscribe(request.options, stream, input);
  input.run(shutdown, live, conversion);
  stream.finish();
  printReport(request, conversion.finish());
  return kSuccess;
}

}  // namespace

int runTumNode(int argc, char** argv) { return pcrb::runNode(argc, argv, kHelp, run); }

}  // namespace pcrb_tools
