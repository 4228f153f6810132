#pragma once

#include <optional>
#include <string>

#include "conversion/conversion.hpp"
#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/datasets/planetary.hpp"
#include "pcrb_core/datasets/tum.hpp"

namespace pcrb {
class ShutdownRequest;
}

namespace pcrb_tools {

struct EthRequest : ConversionRequest {
  EthRequest() { data_set = "eth"; }

  /// Which scan files are read; nothing = the global ones if there are any.
  std::optional<pcrb::EthFrame> frame;
};

/// Converts a sequence of the ETH data set: `csv_global`, or `csv_local` with the Leica poses, from
/// folders and archives (flat or with these folders).
///
/// VIEWPOINT is the scanner's pose where `pose_scanner_leica.csv` is among the files.
/// @throws InvalidFile  for defects of the log; what was complete before stays.
/// @throws InvalidParameter  if the sequence is not given and not in the names.
ConversionReport convertEth(const EthRequest& request);

struct PlanetaryRequest : ConversionRequest {
  PlanetaryRequest() { data_set = "planetary"; }

  double max_malformed = pcrb::kMaxMalformed;  ///< share of a scan's lines that may be no point
};

/// Converts `box_met` or `p2at_met` of the planetary data set: `<set>_NNN.xyz` with `<set>_NNN.gt`
/// beside it, from folders and archives (one for all or one a scan).
///
/// @throws InvalidFile  for defects of the log, a scan without its pose, and scans of two sets.
ConversionReport convertPlanetary(const PlanetaryRequest& request);

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

  std::string poses;  ///< ground truth in any pcrb::PoseFormat with timestamps; empty: beside the
                      ///< bag, or in the log
  TumOptions options;
};

/// Converts a TUM RGB-D sequence: bags with clouds, raw bags with depth images, or the data set's
/// tgz (or its folder) with PNGs.
///
/// Clouds are named by their stamps and moved by the ground truth at these; clouds without a pose
/// are dropped and reported.
/// @throws InvalidFile  for defects of the log; what was complete before stays.
ConversionReport convertTum(const TumRequest& request);

struct KaistRequest : ConversionRequest {
  KaistRequest() { data_set = "kaist"; }

  std::string poses;              ///< global_pose.csv; empty: from the log
  std::string left_calibration;   ///< Vehicle2LeftVLP.txt; empty: from the log
  std::string right_calibration;  ///< Vehicle2RightVLP.txt; empty: from the log
  pcrb::KaistOptions options;
  pcrb::OriginPoints origin = pcrb::OriginPoints::kDrop;
  double max_rate = 0.0;  ///< Hz; 0 = all scans
  std::string left_topic = "/ns1/velodyne_points";
  std::string right_topic = "/ns2/velodyne_points";
};

/// Converts a KAIST urban sequence: its log (folders and archives with sensor_data, calibration and
/// global_pose.csv), or bags of the two velodyne topics together with the poses and calibration.
///
/// A cloud is a left scan and the right scan closest in time, each moved by its own pose; scans
/// without a pose or a partner are dropped and reported.
/// @throws InvalidFile  for defects of the log; what was complete before stays.
/// @throws InvalidParameter  if the sequence is not given and not in the names.
ConversionReport convertKaist(const KaistRequest& request);

/// What live converters are asked for beside the conversion itself.
struct LiveOptions {
  int max_waiting = 64;     ///< clouds that may wait to be converted
  double idle_limit = 0.0;  ///< s without a message after the first one that end it; 0 = never
};

/// Converts what is published, to the same files as offline, until the node is to end or, by the
/// limit, its topics are idle.
///
/// @throws InvalidFile  for defects of the messages and files, at once.
ConversionReport convertLive(const TumRequest& request, const LiveOptions& options,
                             const pcrb::ShutdownRequest& shutdown);

ConversionReport convertLive(const KaistRequest& request, const LiveOptions& options,
                             const pcrb::ShutdownRequest& shutdown);

}  // namespace pcrb_tools
