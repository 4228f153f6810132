#include "conversion/raw_scans.hpp"

#include <png.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb_tools {
namespace {

template <typename Take>
void forEachPoint(const sensor_msgs::PointCloud2& message, const Take& take) {
  const std::size_t count = pcrb::countPoints(message);
  if (count == 0) return;
  const pcrb::PointField x(message, "x");
  const pcrb::PointField y(message, "y");
  const pcrb::PointField z(message, "z");
  for (std::size_t i = 0; i != count; ++i) take(i, Eigen::Vector3d(x[i], y[i], z[i]));
}

pcrb::SensorScan readPoints(const sensor_msgs::PointCloud2& message, pcrb::OriginPoints origin) {
  pcrb::SensorScan scan;
  scan.points.reserve(pcrb::countPoints(message));
  forEachPoint(message,
               [&](std::size_t, const Eigen::Vector3d& point) { scan.add(point, origin); });
  return scan;
}

constexpr std::size_t kMaxPixels = std::size_t{1} << 23;
constexpr std::size_t kHarmlessPixels = std::size_t{1} << 21;  ///< however well they are packed
constexpr std::size_t kMaxPacking = 100;                       ///< pixels of a byte of the file
constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

[[noreturn]] void refusePng(const std::string& name, const std::string& why) {
  throw pcrb::InvalidFile(name, "no depth image: " + why);
}

/// A PNG without its optional chunks: gamma or a colour profile would make libpng change depths.
std::string criticalChunks(std::string_view png, const std::string& name) {
  constexpr std::size_t kFrame = 12;  // length, type and checksum of a chunk
  constexpr char kOptional = 0x20;    // of the first letter of the type
  if (png.substr(0, kPngSignature.size()) != kPngSignature) {
    const bool is_cut = kPngSignature.substr(0, png.size()) == png;
    refusePng(name, is_cut ? "the file ends early" : "found no PNG");
  }
  std::string kept(kPngSignature);
  for (std::size_t begin = kept.size(); begin != png.size();) {
    const std::string_view rest = png.substr(begin);
    const auto* const length = reinterpret_cast<png_const_bytep>(rest.data());
    if (rest.size() < kFrame || png_get_uint_32(length) > rest.size() - kFrame) {
      refusePng(name, "the file ends early");
    }
    const std::string_view chunk = rest.substr(0, png_get_uint_32(length) + kFrame);
    if ((chunk[4] & kOptional) == 0) kept += chunk;
    begin += chunk.size();
  }
  return kept;
}

/// An image that libpng reads, with what it holds meanwhile.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

}  // namespace

pcrb::SensorScan scanOf(const sensor_msgs::PointCloud2& message, pcrb::OriginPoints origin,
                        const std::string& name) {
  try {
    return readPoints(message, origin);
  } catch (const pcrb::InvalidProblem& error) {
    throw pcrb::InvalidFile(name, error.what());
  }
}

pcrb::SensorScan timedScanOf(const sensor_msgs::PointCloud2& message, pcrb::OriginPoints origin,
                             const std::string& name) {
  try {
    const std::vector<double> times = pcrb::pointTimes(message);
    pcrb::SensorScan scan;
    forEachPoint(message, [&](std::size_t i, const Eigen::Vector3d& point) {
      if (scan.add(point, origin) && !times.empty()) scan.times.push_back(times[i]);
    });
    return scan;
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

pcrb::DepthImage DepthPng::view(double units_per_metre) const {
  pcrb::DepthImage image;
  image.width = width;
  image.height = height;
  image.row_bytes = std::size_t{2} * width;
  image.format = pcrb::DepthFormat::kUnsigned16;
  image.units_per_metre = units_per_metre;
  image.bytes = {reinterpret_cast<const char*>(pixels.data()), 2 * pixels.size()};
  return image;
}

DepthPng decodeDepthPng(std::string_view bytes, const std::string& name) {
  const std::string png = criticalChunks(bytes, name);
  PngImage image;
  if (png_image_begin_read_from_memory(&image, png.data(), png.size()) == 0) {
    refusePng(name, image.message);
  }
  if (image.format != PNG_FORMAT_LINEAR_Y) {
    refusePng(name, "found another kind of PNG, expected 16 bits of grey");
  }
  const std::size_t count = std::size_t{image.width} * image.height;
  const std::size_t limit = std::min(kMaxPixels, kHarmlessPixels + kMaxPacking * bytes.size());
  if (count > limit) {
    refusePng(name, "found " + std::to_string(count) + " pixels in " +
                        std::to_string(bytes.size()) + " bytes, expected at most " +
                        std::to_string(limit));
  }
  DepthPng decoded{image.width, image.height, std::vector<std::uint16_t>(count)};
  if (png_image_finish_read(&image, nullptr, decoded.pixels.data(), 0, nullptr) == 0) {
    refusePng(name, image.message);
  }
  return decoded;
}

}  // namespace pcrb_tools
