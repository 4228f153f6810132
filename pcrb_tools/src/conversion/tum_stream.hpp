#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <deque>
#include <optional>
#include <string>

#include "conversion/tum_gate.hpp"

namespace pcrb_tools {

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
  TumGate gate_;
  std::optional<pcrb::Intrinsics> camera_;
  std::deque<sensor_msgs::Image::ConstPtr> waiting_;
};

}  // namespace pcrb_tools
