#pragma once

#include <optional>
#include <string>

#include "conversion/conversion.hpp"
#include "pcrb_core/datasets/tum.hpp"

namespace pcrb_tools {

/// Which messages of a bag become clouds. kAuto: clouds with colour if there are any, else depth.
enum class TumInput { kAuto, kClouds, kDepth };

/// How TUM logs become clouds, offline and live.
struct TumOptions {
  bool nearest = false;                      ///< the nearest pose, without limit, as upstream did
  pcrb::Stamp max_gap = pcrb::kSecond / 10;  ///< between the poses that are interpolated
  /// Hz, 0 = all; nothing: all clouds of a bag, which was thinned by its maker, and depth images at
  /// the 2 Hz of the published sequences.
  std::optional<double> max_rate;
  std::optional<pcrb::Intrinsics> intrinsics;  ///< nothing: camera_info; PNGs: the recommendation
  double depth_units = 1000.0;                 ///< a metre in a 16UC1 image on a topic
  pcrb::OriginPoints origin = pcrb::OriginPoints::kKeep;
  TumInput input = TumInput::kAuto;
  std::string cloud_topic = "/camera/rgb/points";
  std::string depth_topic = "/camera/depth/image";
  std::string info_topic = "/camera/rgb/camera_info";
};

/// The rate that depth images are thinned to, or clouds.
double maxRate(const TumOptions& options, TumInput input);

struct TumRequest : ConversionRequest {
  TumRequest() { data_set = "tum"; }

  std::string poses;  ///< ground-truth file; empty: beside the bag, or in the log
  TumOptions options;
};

/// Converts a TUM RGB-D sequence: bags with clouds, raw bags with depth images, or the data set's
/// tgz (or its folder) with PNGs.
///
/// Clouds are named by their stamps and moved by the ground truth at these; clouds without a pose
/// are dropped and reported.
/// @throws InvalidFile  for defects of the log; what was complete before stays.
ConversionReport convertTum(const TumRequest& request);

}  // namespace pcrb_tools
