#include "conversion/tum_stream.hpp"

#include <utility>

#include "conversion/conversion.hpp"
#include "conversion/raw_scans.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {
namespace {

/// Images that may wait for the camera: it is published with every image.
constexpr std::size_t kMostWaitingImages = 64;

constexpr const char* kNoCamera = "without a camera_info";

}  // namespace

double maxRate(const TumOptions& options, TumInput input) {
  constexpr double kPublishedRate = 2.0;
  return options.max_rate.value_or(input == TumInput::kClouds ? 0.0 : kPublishedRate);
}

TumScanSelector::TumScanSelector(const pcrb::Trajectory& trajectory, const TumOptions& options,
                                 double max_rate, Conversion& conversion)
    : trajectory_(trajectory), options_(options), conversion_(conversion), limiter_(max_rate) {}

std::optional<pcrb::Transform> TumScanSelector::select(pcrb::Stamp stamp) {
  const auto drop = [&](const std::string& reason) {
    conversion_.drop(cloudName(stamp), reason);
    return std::nullopt;
  };
  if (clock_.goesBack(stamp)) conversion_.noteTimeJump();
  const pcrb::PoseLookup lookup = poseAt(stamp);
  if (lookup.status != pcrb::PoseStatus::kFound) {
    conversion_.dropUnposed(cloudName(stamp), stamp, pcrb::toString(lookup.status));
    return std::nullopt;
  }
  const bool is_due = limiter_.keep(stamp);  // asked of a repetition, too: it has its place in time
  if (admitted_.count(stamp) > 0) return drop("the stamp of an earlier one");
  if (!is_due) return drop("beyond the maximal rate");
  admitted_.insert(stamp);
  return lookup.T_world_body;
}

pcrb::PoseLookup TumScanSelector::poseAt(pcrb::Stamp stamp) const {
  if (!options_.nearest) return trajectory_.interpolate(stamp, options_.max_gap);
  return {pcrb::PoseStatus::kFound, trajectory_.nearest(stamp).T_world_body};
}

std::string cameraText(const pcrb::Intrinsics& intrinsics, double units_per_metre) {
  std::string text = "camera";
  for (const double number :
       {intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy, units_per_metre}) {
    text += ' ' + pcrb::formatShortest(number);
  }
  return text;
}

TumStream::TumStream(const pcrb::Trajectory& trajectory, const TumOptions& options, TumInput input,
                     const std::string& identity, Conversion& conversion)
    : options_(options),
      identity_(identity),
      conversion_(conversion),
      selector_(trajectory, options, maxRate(options, input), conversion),
      camera_(options.intrinsics) {}

template <typename MakeScan>
void TumStream::convert(pcrb::Stamp stamp, const std::string& topic, const std::string& how,
                        MakeScan make) {
  const auto pose = selector_.select(stamp);
  if (!pose) return;
  const std::string name = TumScanSelector::cloudName(stamp);
  if (!conversion_.wants(name, identity_ + topic + '\n' + how + poseText(*pose))) return;
  conversion_.add(name, [make, T_world_camera = *pose, label = topic + ' ' + name] {
    return placed(make(label), T_world_camera);
  });
}

void TumStream::addCloud(const sensor_msgs::PointCloud2::ConstPtr& cloud) {
  const pcrb::Stamp stamp = pcrb::stampOf(cloud->header.stamp);
  if (!pcrb::hasField(*cloud, "rgb")) {
    conversion_.drop(TumScanSelector::cloudName(stamp), "without colour");
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
  if (waiting_.size() <= kMostWaitingImages) return;
  conversion_.drop(TumScanSelector::cloudName(pcrb::stampOf(waiting_.front()->header.stamp)),
                   kNoCamera);
  waiting_.pop_front();
}

void TumStream::convertDepth(const sensor_msgs::Image::ConstPtr& image) {
  const double units = options_.depth_units;
  convert(pcrb::stampOf(image->header.stamp), options_.depth_topic, cameraText(*camera_, units),
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
    conversion_.drop(TumScanSelector::cloudName(pcrb::stampOf(image->header.stamp)), kNoCamera);
  }
}

}  // namespace pcrb_tools
