#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/datasets/stamp.hpp"

namespace pcrb {

// The TUM RGB-D sequences (Sturm et al., IROS 2012). Their ground truth is read by
// parseTrajectory().

/// A row of `depth.txt`.
struct TumImage {
  Stamp stamp = 0;
  std::string path;  ///< relative to the list's folder, checked to stay below it
};

/// Reads `depth.txt`: `#` comments, `timestamp path`.
/// @throws InvalidFile  also for a path that is absolute or has `..`.
std::vector<TumImage> parseTumImageList(std::string_view text, const std::string& name);

/// Pinhole camera without distortion, pixels; the centre of the first pixel is (0, 0).
struct Intrinsics {
  double fx = 525.0, fy = 525.0, cx = 319.5, cy = 239.5;  ///< the data set's recommendation
};

/// How the pixels of a depth image are stored.
enum class DepthFormat {
  kFloat32,    ///< metres; NaN, infinite, 0 or less = none
  kUnsigned16  ///< units of 1 / units_per_metre; 0 = none
};

/// A depth image in somebody's memory.
struct DepthImage {
  std::uint32_t width = 0, height = 0;  ///< pixels
  std::size_t row_bytes = 0;            ///< from a row to the next
  DepthFormat format = DepthFormat::kUnsigned16;
  bool big_endian = false;
  double units_per_metre = 5000.0;  ///< kUnsigned16 only; 5000 in TUM's PNGs, 1000 on ROS topics
  std::string_view bytes;
};

/// The points of a depth image in the camera's optical frame, row by row: z = depth,
/// x = (u − cx) z / fx, y = (v − cy) z / fy, in double. Pixels without depth count as non-finite.
///
/// @param name  stands for the path in messages
/// @throws InvalidFile  if there are fewer bytes than the size needs.
/// @throws InvalidParameter  unless the focal lengths and units_per_metre are finite and positive.
SensorScan depthToScan(const DepthImage& image, const Intrinsics& intrinsics,
                       const std::string& name);

/// Thins a stream of stamps to a rate: the first, then each that is due. What is due keeps to the
/// rate on average and tolerates a jitter of a tenth of the period, so a stream that has the rate
/// already loses nothing. A stream that goes back by more than the period is thinned anew.
class RateLimiter {
 public:
  /// @param max_rate  Hz; 0 = let everything pass
  /// @throws InvalidParameter  if negative or not finite.
  explicit RateLimiter(double max_rate);

  /// Whether the cloud of this stamp is kept.
  bool keep(Stamp stamp);

 private:
  Stamp period_ = 0;
  Stamp due_ = 0;
  bool first_ = true;
};

/// The sequence's name in the benchmark: `pioneer_slam` for
/// `rgbd_dataset_freiburg2_pioneer_slam-2hz-with-pointclouds`; a name of another form stays.
std::string tumSequenceName(std::string_view log_name);

}  // namespace pcrb
