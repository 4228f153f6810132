#include <algorithm>
#include <string_view>

#include "common/process.hpp"
#include "common/tool_main.hpp"
#include "conversion/converter_options.hpp"
#include "conversion/converters.hpp"
#include "pcrb_core/parallel.hpp"
#include "pcrb_server/node_main.hpp"

namespace pcrb_tools {
namespace {

using Use = ConverterOptions::Use;

/// What `--help` says of a converter.
struct ConverterHelp {
  std::string description;
  std::string inputs;
  std::string footer;
  std::string live_example;  ///< empty: it has no node
};

void addEthOptions(ConverterOptions& options, EthRequest& request) {
  const auto set = [&request](const std::string& word) {
    if (word != "auto") {
      request.frame = word == "global" ? pcrb::EthFrame::kGlobal : pcrb::EthFrame::kLocal;
    }
  };
  options.addChoice("frame", set, {"auto", "global", "local"}, {"auto", "global", "local"},
                    "scans to read: global (PointCloudN.csv), local (Hokuyo_N.csv, moved by the "
                    "Leica poses), auto (global if there are any)");
}

void addTumOptions(ConverterOptions& list, TumRequest& request) {
  TumOptions& options = request.options;
  list.addText("poses", request.poses,
               "ground-truth file [beside the bag, or groundtruth.txt of the log]",
               Use::kRequiredLive);
  list.addSwitch(
      "nearest", [&options] { options.nearest = true; },
      "take the nearest pose, however far in time, as the published clouds did");
  list.addSeconds("max_gap", options.max_gap,
                  "refuse clouds between poses further apart than this, s");
  list.addNumber(
      "max_rate", [&options](double rate) { options.max_rate = rate; },
      "thin to this rate, Hz; 0 = all [0 for clouds, 2 for depth images as in the published "
      "sequences]");
  const auto set_input = [&options](const std::string& word) {
    options.input = word == "auto"     ? TumInput::kAuto
                    : word == "clouds" ? TumInput::kClouds
                                       : TumInput::kDepth;
  };
  list.addChoice("input", set_input, {"auto", "clouds", "depth"}, {"clouds", "depth"},
                 "messages to convert: clouds, depth images with their camera_info, or, of a bag, "
                 "auto (clouds if there are any)");
  const auto set_camera = [&options](const std::vector<double>& n) {
    options.intrinsics = pcrb::Intrinsics{n[0], n[1], n[2], n[3]};
  };
  list.addNumbers(
      "intrinsics", 4, set_camera,
      "fx fy cx cy of the camera in pixels [camera_info; 525 525 319.5 239.5 for PNGs]");
  list.addNumber("depth_units", options.depth_units, "units of a metre in 16UC1 images on a topic");
  list.addSwitch(
      "drop_origin", [&options] { options.origin = pcrb::OriginPoints::kDrop; },
      "leave out points at exactly (0, 0, 0)");
  list.addText("cloud_topic", options.cloud_topic, "topic of the clouds");
  list.addText("depth_topic", options.depth_topic, "topic of the depth images");
  list.addText("info_topic", options.info_topic, "topic of the depth images' camera_info");
}

void addKaistOptions(ConverterOptions& list, KaistRequest& request) {
  pcrb::KaistOptions& options = request.options;
  list.addText("poses", request.poses, "global_pose.csv [the one in the log]", Use::kRequiredLive);
  list.addText("left_calibration", request.left_calibration,
               "Vehicle2LeftVLP.txt [the one in the log]", Use::kRequiredLive);
  list.addText("right_calibration", request.right_calibration,
               "Vehicle2RightVLP.txt [the one in the log]", Use::kRequiredLive);
  list.addSwitch(
      "interpolate", [&options] { options.interpolate = true; },
      "interpolate between the poses around a scan instead of taking the closest one");
  list.addSeconds("max_pose_gap", options.max_pose_gap,
                  "refuse scans farther from a pose (or between poses farther apart), s");
  list.addSeconds("max_pair_gap", options.max_pair_gap,
                  "refuse left scans without a right one this close in time, s");
  list.addNumbers(
      "frame_offset", 3,
      [&options](const std::vector<double>& n) {
        options.frame_offset = {n[0], n[1], n[2]};
      },
      "x y z in m, added to UTM: what check_dataset says of the published problem files");
  list.addNumber("max_rate", request.max_rate, "thin to this rate, Hz; 0 = all scans");
  list.addSwitch(
      "keep_origin", [&request] { request.origin = pcrb::OriginPoints::kKeep; },
      "keep points at exactly (0, 0, 0), which are no returns");
  list.addText("left_topic", request.left_topic, "topic of the left sensor's scans");
  list.addText("right_topic", request.right_topic, "topic of the right sensor's scans");
}

/// The options that all converters have.
void addCommonOptions(ConverterOptions& options, ConversionRequest& request, LiveOptions& live) {
  constexpr int kMostThreads = 1024;
  constexpr int kMostWaiting = 1 << 20;
  request.threads = pcrb::processorCount();
  options.addPath("root", request.root,
                  "root of the common layout: clouds go to ROOT/DATA_SET/SEQUENCE/*.pcd");
  options.addText("data_set", request.data_set, "folder of the data set");
  options.addText("sequence", request.sequence,
                  "folder of the sequence [from the names of the inputs]", Use::kRequiredLive);
  options.addInteger("threads", request.threads, 1, kMostThreads,
                     "number of threads, which does not change a byte");
  options.addSwitch(
      "force", [&request] { request.force = true; }, "replace clouds that no converter made");
  options.addInteger("max_waiting", live.max_waiting, 1, kMostWaiting,
                     "clouds that may wait to be converted; what comes beyond is dropped and "
                     "counted",
                     Use::kOnlyLive);
  options.addNumber("idle_limit", live.idle_limit,
                    "end when nothing has come for this long after the first message, s; 0 = never",
                    Use::kOnlyLive);
}

template <typename Request>
int runOffline(int argc, char** argv, const ConverterHelp& help, const ConverterOptions& options,
               Request& request, ConversionReport (*convert)(const Request&)) {
  CLI::App app(help.description);
  app.add_option("INPUT", request.inputs, help.inputs)->required();
  options.addFlags(app);
  app.footer(help.footer);
  return runTool(app, argc, argv, [&] {
    const Interruption interruption;
    printReport(request, convert(request));
    return kSuccess;
  });
}

template <typename Request>
int runAsNode(int argc, char** argv, const ConverterHelp& help, const ConverterOptions& options,
              Request& request, const LiveOptions& live) {
  const pcrb::NodeHelp node_help{
      request.data_set + "_to_pcd",
      help.description + " While it is published, to the same files as offline.",
      "Ends when it is interrupted, or by ~idle_limit, with a report. Example:\n  " +
          help.live_example,
      options.parameters()};
  return pcrb::runNode(argc, argv, node_help, [&](pcrb::ShutdownRequest& shutdown) {
    pcrb::NodeParameters parameters(options.parameters());
    options.read(parameters);
    parameters.finish();
    printReport(request, convertLive(request, live, shutdown));
    return kSuccess;
  });
}

/// Whether the command line has `--live`, which makes a converter a node; it is taken away.
bool takeLiveFlag(int& argc, char** argv) {
  char** const end = std::remove_if(argv, argv + argc, [](const char* argument) {
    return std::string_view(argument) == "--live";
  });
  const bool live = end != argv + argc;
  argc = static_cast<int>(end - argv);
  return live;
}

}  // namespace

// The programs, which tools/main.cpp calls; the last two are nodes with `--live`.

namespace eth_to_pcd {
int run(int argc, char** argv) {
  const ConverterHelp help{
      "Converts a sequence of the ETH / ASL data set.",
      "folders or archives (zip, tgz) with csv_global or with csv_local and leica",
      "Example: eth_to_pcd ~/logs/eth/apartment --root ~/benchmark", ""};
  EthRequest request;
  LiveOptions live;
  ConverterOptions options;
  addCommonOptions(options, request, live);
  addEthOptions(options, request);
  return runOffline(argc, argv, help, options, request, convertEth);
}
}  // namespace eth_to_pcd

namespace planetary_to_pcd {
int run(int argc, char** argv) {
  const ConverterHelp help{
      "Converts box_met or p2at_met of the Canadian planetary emulation terrain data set.",
      "folders or archives (zip, tgz) with <set>_NNN.xyz and .gt",
      "Example: planetary_to_pcd ~/logs/planetary/p2at_met --root ~/benchmark", ""};
  PlanetaryRequest request;
  LiveOptions live;
  ConverterOptions options;
  addCommonOptions(options, request, live);
  options.addNumber("max_malformed", request.max_malformed,
                    "share of a scan's lines that may be no point, 0 to 1");
  return runOffline(argc, argv, help, options, request, convertPlanetary);
}
}  // namespace planetary_to_pcd

namespace tum_to_pcd {
int run(int argc, char** argv) {
  const ConverterHelp help{
      "Converts a sequence of the TUM RGB-D data set.",
      "bags with clouds, raw bags with depth images and camera_info, or the data set's tgz or "
      "folder with depth.txt and PNGs",
      "Example: tum_to_pcd rgbd_dataset_freiburg2_pioneer_slam-2hz-with-pointclouds.bag "
      "--root ~/benchmark\n"
      "As a node, on what rosbag play or a camera publishes: --live (--live --help)",
      "rosrun pcrb_tools tum_to_pcd --live _root:=$HOME/benchmark _sequence:=pioneer_slam \\\n"
      "    _poses:=$HOME/logs/rgbd_dataset_freiburg2_pioneer_slam-groundtruth.txt"};
  TumRequest request;
  LiveOptions live;
  ConverterOptions options;
  addCommonOptions(options, request, live);
  addTumOptions(options, request);
  if (takeLiveFlag(argc, argv)) return runAsNode(argc, argv, help, options, request, live);
  return runOffline(argc, argv, help, options, request, convertTum);
}
}  // namespace tum_to_pcd

namespace kaist_to_pcd {
int run(int argc, char** argv) {
  const ConverterHelp help{
      "Converts a sequence of the KAIST urban data set.",
      "folders or archives (tgz, zip) with sensor_data, calibration and global_pose.csv, or bags "
      "of the two velodyne topics",
      "Example: kaist_to_pcd ~/logs/kaist/urban05 --root ~/benchmark\n"
      "As a node, on what the data set's player or rosbag play publishes: --live (--live --help)",
      "rosrun pcrb_tools kaist_to_pcd --live _root:=$HOME/benchmark _sequence:=urban05 \\\n"
      "    _poses:=global_pose.csv _left_calibration:=calibration/Vehicle2LeftVLP.txt \\\n"
      "    _right_calibration:=calibration/Vehicle2RightVLP.txt"};
  KaistRequest request;
  LiveOptions live;
  ConverterOptions options;
  addCommonOptions(options, request, live);
  addKaistOptions(options, request);
  if (takeLiveFlag(argc, argv)) return runAsNode(argc, argv, help, options, request, live);
  return runOffline(argc, argv, help, options, request, convertKaist);
}
}  // namespace kaist_to_pcd

}  // namespace pcrb_tools
