#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conversion/conversion_report.hpp"
#include "pcrb_core/datasets/cloud_file.hpp"
#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb_tools {

/// A log of somebody's own: bags, or folders and archives of clouds, and poses from anywhere.
struct OwnRequest : ConversionRequest {
  OwnRequest() { data_set = "own"; }

  // Where the clouds and the poses are; what is empty is found where there is one only.
  std::string cloud_topic;
  std::string poses;  ///< a text of poses
  std::optional<pcrb::PoseFormat> pose_format;
  std::string pose_topic;
  std::vector<std::string> tf;  ///< the world's frame and the body's, whose motion is on tf
  std::string times;            ///< a text of a timestamp a line, of the clouds of a folder

  // What the poses mean.
  bool in_world = false;    ///< the clouds are in the world's frame; poses say where the sensor was
  std::string world_frame;  ///< tf frame that the clouds are wanted in; empty = that of the poses
  std::string body_frame;   ///< tf frame that poses are of
  std::optional<pcrb::Transform> T_body_sensor;
  double time_offset = 0.0;                 ///< s, added to the stamps of the poses
  pcrb::Stamp max_gap = pcrb::kSecond / 4;  ///< between the poses that are interpolated

  // Which scans, and how.
  double min_distance = 0.0;  ///< m between the sensor's places of two clouds
  double max_rate = 0.0;      ///< Hz; 0 = all
  bool deskew = false;        ///< move each point by the pose at its own time
  pcrb::CloudFileOptions files;
};

/// Converts such a log to clouds in the world's frame, with the sensor's poses as VIEWPOINTs.
///
/// Clouds of bags are named by their stamps, those of files by these. Scans without a pose are
/// dropped and reported.
/// @throws InvalidFile  for defects of the log; if several topics or files could be meant, naming
///                      them and the option that chooses; if no scan has a pose, with both time
///                      ranges and a guess.
ConversionReport convertOwn(const OwnRequest& request);

}  // namespace pcrb_tools
