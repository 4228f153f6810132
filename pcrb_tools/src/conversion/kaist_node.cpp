#include <vector>

#include "common/tool_main.hpp"
#include "conversion/kaist_stream.hpp"
#include "conversion/live_node.hpp"
#include "conversion/live_run.hpp"

namespace pcrb_tools {
namespace {

const pcrb::NodeHelp kHelp{
    "kaist_to_pcd",
    "Converts a KAIST urban sequence while the data set's player or rosbag publishes it, to the "
    "same files as offline.",
    std::string("Private parameters (default):") + kLiveParametersHelp + R"(
  poses              global_pose.csv (required)
  left_calibration   Vehicle2LeftVLP.txt (required)
  right_calibration  Vehicle2RightVLP.txt (required)
  interpolate (false)   interpolate between poses instead of taking the closest one
  max_pose_gap (0.1)    refuse scans farther from a pose than this, s
  max_pair_gap (0.1)    refuse left scans without a right one this close in time, s
  max_rate (0)          thin to this rate, Hz; 0 = all scans
  frame_offset          "x y z" in m, added to UTM
  keep_origin (false)   keep points at exactly (0, 0, 0), which are no returns
  left_topic (/ns1/velodyne_points), right_topic (/ns2/velodyne_points)

Ends when it is interrupted, or by ~idle_limit, with a report. Example:
  rosrun pcrb_tools kaist_to_pcd --live _root:=$HOME/benchmark _sequence:=urban05 \
    _poses:=global_pose.csv _left_calibration:=calibration/Vehicle2LeftVLP.txt \
    _right_calibration:=calibration/Vehicle2RightVLP.txt)"};

struct LiveKaistRequest {
  KaistRequest conversion;
  LiveOptions live;
};

LiveKaistRequest readRequest() {
  LiveKaistRequest result;
  KaistRequest& request = result.conversion;
  pcrb::KaistOptions& options = request.options;
  pcrb::NodeParameters parameters;
  result.live = readLiveParameters(parameters, request);
  request.poses = parameters.requiredString("poses");
  request.left_calibration = parameters.requiredString("left_calibration");
  request.right_calibration = parameters.requiredString("right_calibration");
  options.interpolate = parameters.boolean("interpolate", false);
  options.max_pose_gap = pcrb::toStamp(parameters.number("max_pose_gap", 0.1, 0.0, 1e6));
  options.max_pair_gap = pcrb::toStamp(parameters.number("max_pair_gap", 0.1, 0.0, 1e6));
  request.max_rate = parameters.number("max_rate", 0.0, 0.0, 1e6);
  const auto offset = readNumbers(parameters, "frame_offset", 3);
  if (!offset.empty()) options.frame_offset = {offset[0], offset[1], offset[2]};
  if (parameters.boolean("keep_origin", false)) request.origin = pcrb::OriginPoints::kKeep;
  request.left_topic = parameters.string("left_topic", request.left_topic);
  request.right_topic = parameters.string("right_topic", request.right_topic);
  parameters.finish();
  return result;
}

int run(pcrb::ShutdownRequest& shutdown) {
  const auto [request, live] = readRequest();
  const KaistFrames frames = readFrames(request, nullptr);
  Conversion conversion(request, request.sequence, 0);
  KaistStream stream(frames, request, request.sequence, "live ", conversion);
  LiveInput input;
  input.subscribe<sensor_msgs::PointCloud2>(request.left_topic,
                                            [&stream](const auto& scan) { stream.addLeft(scan); });
  input.subscribe<sensor_msgs::PointCloud2>(request.right_topic,
                                            [&stream](const auto& scan) { stream.addRight(scan); });
  input.run(shutdown, live, conversion);
  stream.finish();
  printReport(request, conversion.finish());
  return kSuccess;
}

}  // namespace

int runKaistNode(int argc, char** argv) { return pcrb::runNode(argc, argv, kHelp, run); }

}  // namespace pcrb_tools
