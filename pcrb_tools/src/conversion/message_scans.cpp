#include "conversion/message_scans.hpp"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {
namespace {

pcrb::SensorScan readPoints(const sensor_msgs::PointCloud2& message, pcrb::OriginPoints origin) {
  const std::size_t count = pcrb::countPoints(message);
  const pcrb::PointField x(message, "x");
  const pcrb::PointField y(message, "y");
  const pcrb::PointField z(message, "z");
  pcrb::SensorScan scan;
  scan.points.reserve(count);
  for (std::size_t i = 0; i != count; ++i) scan.add({x[i], y[i], z[i]}, origin);
  return scan;
}

}  // namespace

pcrb::Stamp stampOf(const ros::Time& time) {
  return static_cast<pcrb::Stamp>(time.sec) * pcrb::kSecond + time.nsec;
}

pcrb::SensorScan scanOf(const sensor_msgs::PointCloud2& message, pcrb::OriginPoints origin,
                        const std::string& name) {
  try {
    return readPoints(message, origin);
  } catch (const pcrb::InvalidProblem& error) {
    throw pcrb::InvalidFile(name, error.what());
  }
}

pcrb::SensorScan scanOf(const sensor_msgs::Image& image, const pcrb::Intrinsics& intrinsics,
                        double units_per_metre, const std::string& name) {
  namespace encodings = sensor_msgs::image_encodings;
  pcrb::DepthImage depth;
  depth.width = image.width;
  depth.height = image.height;
  depth.row_bytes = image.step;
  depth.big_endian = image.is_bigendian != 0;
  depth.units_per_metre = units_per_metre;
  depth.bytes = {reinterpret_cast<const char*>(image.data.data()), image.data.size()};
  if (image.encoding == encodings::TYPE_32FC1) {
    depth.format = pcrb::DepthFormat::kFloat32;
  } else if (image.encoding != encodings::TYPE_16UC1 && image.encoding != encodings::MONO16) {
    throw pcrb::InvalidFile(name, 0, "an image of encoding '" + image.encoding + "'",
                            "depth as 32FC1 or 16UC1");
  }
  return pcrb::depthToScan(depth, intrinsics, name);
}

pcrb::Intrinsics intrinsicsOf(const sensor_msgs::CameraInfo& info, const std::string& name) {
  const bool distorted =
      std::any_of(info.D.begin(), info.D.end(), [](double entry) { return entry != 0.0; });
  const bool cropped =
      info.binning_x > 1 || info.binning_y > 1 || info.roi.x_offset != 0 || info.roi.y_offset != 0;
  const bool skewed = info.K[1] != 0.0;
  if (distorted || cropped || skewed || !(info.K[0] > 0.0 && info.K[4] > 0.0)) {
    throw pcrb::InvalidFile(name, 0, "a camera with distortion, binning or no focal length",
                            "a pinhole camera (or give fx fy cx cy)");
  }
  return {info.K[0], info.K[4], info.K[2], info.K[5]};
}

}  // namespace pcrb_tools
