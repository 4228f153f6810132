#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <deque>
#include <optional>
#include <set>
#include <string>

#include "conversion/converters.hpp"
#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/datasets/tum.hpp"

namespace pcrb_tools {

/// Decides which clouds of a TUM log are converted, and with which pose: the same for bags, PNGs
/// and live topics.
class TumScanSelector {
 public:
  /// All but the number must outlive it.
  /// @param max_rate  Hz; 0 = all
  TumScanSelector(const pcrb::Trajectory& trajectory, const TumOptions& options, double max_rate,
                  Conversion& conversion);

  /// The pose of a cloud that is to be converted; else it is dropped from the conversion with the
  /// reason. Only clouds with a pose count against the rate.
  std::optional<pcrb::Transform> select(pcrb::Stamp stamp);

  /// A cloud's file name: `1311878220.377686160.pcd`.
  static std::string cloudName(pcrb::Stamp stamp) { return pcrb::formatStamp(stamp) + ".pcd"; }

 private:
  pcrb::PoseLookup poseAt(pcrb::Stamp stamp) const;

  const pcrb::Trajectory& trajectory_;
  const TumOptions& options_;
  Conversion& conversion_;
  pcrb::RateLimiter limiter_;
  pcrb::StreamClock clock_;
  std::set<pcrb::Stamp> admitted_;
};

/// Camera and units for fingerprints.
std::string cameraText(const pcrb::Intrinsics& intrinsics, double units_per_metre);

/// Makes clouds of messages in the order of their stamps, from a bag or live.
class TumStream {
 public:
  /// Trajectory, options and conversion must outlive it.
  /// @param input     kClouds or kDepth
  /// @param identity  of the stream, for fingerprints
  TumStream(const pcrb::Trajectory& trajectory, const TumOptions& options, TumInput input,
            const std::string& identity, Conversion& conversion);

  /// Clouds without colour are dropped.
  void addCloud(const sensor_msgs::PointCloud2::ConstPtr& cloud);

  /// Waits for the camera, unless the options have one.
  void addDepth(const sensor_msgs::Image::ConstPtr& image);

  /// @throws InvalidFile  if it is no pinhole camera, or another one than before.
  void setCamera(const sensor_msgs::CameraInfo& info);

  bool hasCamera() const { return camera_.has_value(); }

  /// Drops the images that still wait for a camera.
  void finish();

 private:
  void convertDepth(const sensor_msgs::Image::ConstPtr& image);

  /// @param make  gives the scan for a name that is used in messages
  template <typename MakeScan>
  void convert(pcrb::Stamp stamp, const std::string& topic, const std::string& how, MakeScan make);

  const TumOptions& options_;
  std::string identity_;
  Conversion& conversion_;
  TumScanSelector selector_;
  std::optional<pcrb::Intrinsics> camera_;
  std::deque<sensor_msgs::Image::ConstPtr> waiting_;
};

}  // namespace pcrb_tools
