#include <cmath>
#include <limits>

#include "pcrb_core/datasets/tum.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/byte_order.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

/// Depth of a pixel in m, NaN where there is none: whatever is not in front of the camera.
double loadDepth(const char* pixel, const DepthImage& image) {
  double depth = 0.0;
  if (image.format == DepthFormat::kUnsigned16) {
    depth = static_cast<double>(loadUnsigned(pixel, 2, image.big_endian)) / image.units_per_metre;
  } else {
    depth = loadFloat<float>(pixel, image.big_endian);
  }
  return depth > 0.0 ? depth : std::numeric_limits<double>::quiet_NaN();
}

void requirePositive(double value, const char* what) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InvalidParameter(std::string("found ") + what + " of " + formatShortest(value) +
                           ", expected a positive number");
  }
}

void check(const DepthImage& image, std::size_t pixel_bytes, const std::string& name) {
  const std::size_t line = image.width * pixel_bytes;
  const std::size_t rows = image.height;
  const bool fits = line <= image.row_bytes && line > 0 && rows > 0 && image.bytes.size() >= line &&
                    rows - 1 <= (image.bytes.size() - line) / image.row_bytes;
  if (!fits) {
    throw InvalidFile(name, 0,
                      "a depth image of " + std::to_string(image.width) + " x " +
                          std::to_string(image.height) + " with rows of " +
                          std::to_string(image.row_bytes) + " bytes in " +
                          std::to_string(image.bytes.size()) + " bytes",
                      "at least " + std::to_string(pixel_bytes) + " bytes a pixel");
  }
}

}  // namespace

SensorScan depthToScan(const DepthImage& image, const Intrinsics& intrinsics,
                       const std::string& name) {
  const std::size_t pixel_bytes = image.format == DepthFormat::kFloat32 ? 4 : 2;
  check(image, pixel_bytes, name);
  requirePositive(intrinsics.fx, "a focal length");
  requirePositive(intrinsics.fy, "a focal length");
  requirePositive(image.units_per_metre, "a depth scale");
  SensorScan scan;
  scan.points.reserve(std::size_t{image.width} * image.height);
  for (std::uint32_t v = 0; v != image.height; ++v) {
    const char* pixel = image.bytes.data() + v * image.row_bytes;
    const double y = (v - intrinsics.cy) / intrinsics.fy;
    for (std::uint32_t u = 0; u != image.width; ++u, pixel += pixel_bytes) {
      const double z = loadDepth(pixel, image);
      scan.add({(u - intrinsics.cx) * z / intrinsics.fx, y * z, z}, OriginPoints::kKeep);
    }
  }
  return scan;
}

}  // namespace pcrb
