#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "conversion/bag_messages.hpp"
#include "conversion/message_scans.hpp"
#include "conversion/pose_text.hpp"
#include "conversion/tum_gate.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_server/point_fields.hpp"

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

/// One run over bags.
class TumBags {
 public:
  TumBags(const TumRequest& request, const BagMessages& bags, const pcrb::Trajectory& trajectory,
          Conversion& conversion)
      : options_(request.options),
        bags_(bags),
        conversion_(conversion),
        gate_(trajectory, options_, conversion) {}

  void convertClouds() {
    bags_.forEach({options_.cloud_topic}, [this](const rosbag::MessageInstance& instance) {
      const auto cloud = messageAs<sensor_msgs::PointCloud2>(instance);
      const pcrb::Stamp stamp = stampOf(cloud->header.stamp);
      if (!pcrb::hasField(*cloud, "rgb")) {
        conversion_.drop(TumGate::cloudName(stamp), "without colour");
        return;
      }
      add(stamp, instance.getTopic(), "", [cloud, origin = options_.origin](const auto& name) {
        return scanOf(*cloud, origin, name);
      });
    });
  }

  void convertDepth() {
    const pcrb::Intrinsics intrinsics = options_.intrinsics ? *options_.intrinsics : findCamera();
    const double units = options_.depth_units;
    bags_.forEach({options_.depth_topic}, [&](const rosbag::MessageInstance& instance) {
      const auto image = messageAs<sensor_msgs::Image>(instance);
      add(stampOf(image->header.stamp), instance.getTopic(), cameraText(intrinsics, units),
          [image, intrinsics, units](const auto& name) {
            return scanOf(*image, intrinsics, units, name);
          });
    });
  }

 private:
  template <typename MakeScan>
  void add(pcrb::Stamp stamp, const std::string& topic, const std::string& camera, MakeScan make) {
    const auto pose = gate_.admit(stamp);
    if (!pose) return;
    const std::string name = TumGate::cloudName(stamp);
    const std::string origin = bags_.identity() + topic + '\n' + camera +
                               (options_.origin == pcrb::OriginPoints::kDrop ? " drop" : " keep") +
                               poseText(*pose);
    if (!conversion_.wants(name, origin)) return;
    conversion_.add(name, [make, T_world_camera = *pose, label = topic + ' ' + name] {
      pcrb::SensorScan scan = make(label);
      const pcrb::PointCounts counts = scan.counts;
      return ConvertedScan{pcrb::placeScan(std::move(scan), T_world_camera), counts};
    });
  }

  /// The one camera of all messages.
  pcrb::Intrinsics findCamera() const {
    std::optional<pcrb::Intrinsics> camera;
    bags_.forEach({options_.info_topic}, [&](const rosbag::MessageInstance& instance) {
      const auto info = messageAs<sensor_msgs::CameraInfo>(instance);
      const pcrb::Intrinsics found = intrinsicsOf(*info, instance.getTopic());
      if (camera && cameraText(*camera, 0) != cameraText(found, 0)) {
        throw pcrb::InvalidFile(instance.getTopic(), 0, "two cameras",
                                "one (or give fx fy cx cy: --intrinsics)");
      }
      camera = found;
    });
    if (!camera) {
      throw pcrb::InvalidFile("topic " + options_.info_topic, 0, "no message",
                              "the camera (or give fx fy cx cy: --intrinsics)");
    }
    return *camera;
  }

  const TumOptions& options_;
  const BagMessages& bags_;
  Conversion& conversion_;
  TumGate gate_;
};

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
  TumBags run(request, bags, trajectory, conversion);
  if (input == TumInput::kClouds) {
    run.convertClouds();
  } else {
    run.convertDepth();
  }
  return conversion.finish();
}

}  // namespace pcrb_tools
