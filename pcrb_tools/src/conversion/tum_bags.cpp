#include <filesystem>

#include "archives/bag_messages.hpp"
#include "conversion/tum_stream.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCloudsSuffix = "-2hz-with-pointclouds";

/// `…/rgbd_dataset_freiburg2_pioneer_slam` for `….bag` and `…-2hz-with-pointclouds.bag`.
std::string logPath(const std::string& bag) {
  std::string path = fs::path(bag).replace_extension().string();
  const std::size_t suffix = path.rfind(kCloudsSuffix);
  if (suffix != std::string::npos) path.resize(suffix);
  return path;
}

std::string posePath(const TumRequest& request) {
  if (!request.poses.empty()) return request.poses;
  const std::string log = logPath(request.inputs.front());
  const std::string beside = log + "-groundtruth.txt";
  if (!fs::exists(beside)) {
    throw pcrb::InvalidFile(beside, 0, "nothing", "the ground truth (or give its file: --poses)");
  }
  return beside;
}

void convertClouds(const TumOptions& options, const BagMessages& bags, TumStream& stream) {
  bags.forEach({options.cloud_topic}, [&stream](const rosbag::MessageInstance& message) {
    stream.addCloud(messageAs<sensor_msgs::PointCloud2>(message));
  });
}

void convertDepth(const TumOptions& options, const BagMessages& bags, TumStream& stream) {
  // All cameras first: they must agree before an image is converted.
  bags.forEach({options.info_topic}, [&stream](const rosbag::MessageInstance& message) {
    stream.setCamera(*messageAs<sensor_msgs::CameraInfo>(message));
  });
  if (!stream.hasCamera()) {
    throw pcrb::InvalidFile("topic " + options.info_topic, 0, "no message",
                            "the camera (or give fx fy cx cy: intrinsics)");
  }
  bags.forEach({options.depth_topic}, [&stream](const rosbag::MessageInstance& message) {
    stream.addDepth(messageAs<sensor_msgs::Image>(message));
  });
}

/// What to read, settled for kAuto.
TumInput chooseInput(const TumOptions& options, const BagMessages& bags) {
  if (options.input != TumInput::kAuto) return options.input;
  return bags.count({options.cloud_topic}) > 0 ? TumInput::kClouds : TumInput::kDepth;
}

}  // namespace

ConversionReport convertTumBags(const TumRequest& request) {
  const BagMessages bags(request.inputs);
  const std::string poses = posePath(request);
  const pcrb::Trajectory trajectory =
      pcrb::parseTumTrajectory(pcrb::FileBytes(poses).text(), poses);
  const TumInput input = chooseInput(request.options, bags);
  const std::string topic =
      input == TumInput::kClouds ? request.options.cloud_topic : request.options.depth_topic;
  const std::size_t total = bags.count({topic});
  if (total == 0) {
    throw pcrb::InvalidFile(request.inputs.front(), 0, "no message on " + topic,
                            "clouds or depth images");
  }
  const std::string log_name = fs::path(logPath(request.inputs.front())).filename().string();
  Conversion conversion(
      request, request.sequence.empty() ? pcrb::tumSequenceName(log_name) : request.sequence,
      total);
  noteTrajectory(trajectory, conversion);
  TumStream stream(trajectory, request.options, input, bags.identity(), conversion);
  if (input == TumInput::kClouds) {
    convertClouds(request.options, bags, stream);
  } else {
    convertDepth(request.options, bags, stream);
  }
  return conversion.finish();
}

}  // namespace pcrb_tools
