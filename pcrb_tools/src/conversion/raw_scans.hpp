#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/datasets/tum.hpp"

namespace pcrb_tools {

/// The points of a message, in double; fields are found by name.
/// @param name  for messages of errors: the cloud's topic and stamp
/// @throws InvalidFile  for messages whose fields or sizes make no sense.
pcrb::SensorScan scanOf(const sensor_msgs::PointCloud2& message, pcrb::OriginPoints origin,
                        const std::string& name);

/// The same with the times of the points, where a field of pcrb::pointTimeScale() has them.
pcrb::SensorScan timedScanOf(const sensor_msgs::PointCloud2& message, pcrb::OriginPoints origin,
                             const std::string& name);

/// The points of a depth image, 32FC1 in metres or 16UC1 (mono16) in units.
/// @param units_per_metre  of 16UC1; 1000 by convention of ROS (REP 118)
/// @throws InvalidFile  for other encodings and sizes that make no sense.
pcrb::SensorScan scanOf(const sensor_msgs::Image& image, const pcrb::Intrinsics& intrinsics,
                        double units_per_metre, const std::string& name);

/// The pinhole camera of a message.
/// @throws InvalidFile  for distortion, binning and regions of interest: they would change every
///                      point, and the data set has none.
pcrb::Intrinsics intrinsicsOf(const sensor_msgs::CameraInfo& info, const std::string& name);

/// A decoded depth image.
struct DepthPng {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint16_t> pixels;  ///< row by row

  /// A view of the pixels, which must outlive it.
  pcrb::DepthImage view(double units_per_metre) const;
};

/// Decodes a PNG with 16 bits of grey, to the numbers that are stored: gamma and the like change no
/// depth.
/// @param name  stands for the path in messages
/// @throws InvalidFile  if it is damaged, of another kind, or claims more pixels than a sensor
///                      has (2^23; 2^21 and 100 a byte of the file): that is refused before
///                      memory is taken for them.
DepthPng decodeDepthPng(std::string_view bytes, const std::string& name);

}  // namespace pcrb_tools
