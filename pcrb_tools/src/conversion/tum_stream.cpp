#include "conversion/tum_stream.hpp"

#include <utility>

#include "conversion/message_scans.hpp"
#include "conversion/pose_text.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {
namespace {

/// Images that may wait for the camera: it is published with every image.
constexpr std::size_t kMostWaiting = 64;

constexpr const char* kNoCamera = "without a camera_info";

}  // namespace

TumStream::TumStream(const pcrb::Trajectory& trajectory, const TumOptions& options, TumInput input,
                     const std::string& identity, Conversion& conversion)
    : options_(options),
      identity_(identity),
      conversion_(conversion),
      gate_(trajectory, options, maxRate(options, input), conversion),
      camera_(options.intrinsics) {}

template <typename MakeScan>
void TumStream::convert(pcrb::Stamp stamp, const std::string& topic, const std::string& how,
                        MakeScan make) {
  const auto pose = gate_.admit(stamp);
  if (!pose) return;
  const std::string name = TumGate::cloudName(stamp);
  if (!conversion_.wants(name, identity_ + topic + '\n' + how + poseText(*pose))) return;
  conversion_.add(name, [make, T_world_camera = *pose, label = topic + ' ' + name] {
    pcrb::SensorScan scan = make(label);
    const pcrb::PointCounts counts = scan.counts;
    return ConvertedScan{pcrb::placeScan(std::move(scan), T_world_camera), counts};
  });
}

void TumStream::addCloud(const sensor_msgs::PointCloud2::ConstPtr& cloud) {
  const pcrb::Stamp stamp = stampOf(cloud->header.stamp);
  if (!pcrb::hasField(*cloud, "rgb")) {
    conversion_.drop(TumGate::cloudName(stamp), "without colour");
    return;
  }
  const bool drops = options_.origin == pcrb::OriginPoints::kDrop;
  convert(stamp, options_.cloud_topic, drops ? "drop" : "keep",
          [cloud, origin = options_.origin](const std::string& name) {
            return scanOf(*cloud, origin, name);
          });
}

void TumStream::addDepth(const sensor_msgs::Image::ConstPtr& image) {
  if (camera_) {
    convertDepth(image);
    return;
  }
  waiting_.push_back(image);
  if (waiting_.size() <= kMostWaiting) return;
  conversion_.drop(TumGate::cloudName(stampOf(waiting_.front()->header.stamp)), kNoCamera);
  waiting_.pop_front();
}

void TumStream::convertDepth(const sensor_msgs::Image::ConstPtr& image) {
  const double units = options_.depth_units;
  convert(stampOf(image->header.stamp), options_.depth_topic, cameraText(*camera_, units),
          [image, camera = *camera_, units](const std::string& name) {
            return scanOf(*image, camera, units, name);
          });
}

void TumStream::setCamera(const sensor_msgs::CameraInfo& info) {
  if (options_.intrinsics) return;
  const pcrb::Intrinsics found = intrinsicsOf(info, "topic " + options_.info_topic);
  if (camera_ && cameraText(*camera_, 0.0) != cameraText(found, 0.0)) {
    throw pcrb::InvalidFile("topic " + options_.info_topic, 0, "two cameras",
                            "one (or give fx fy cx cy: intrinsics)");
  }
  camera_ = found;
  for (const auto& image : std::exchange(waiting_, {})) convertDepth(image);
}

void TumStream::finish() {
  for (const auto& image : std::exchange(waiting_, {})) {
    conversion_.drop(TumGate::cloudName(stampOf(image->header.stamp)), kNoCamera);
  }
}

}  // namespace pcrb_tools
