#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "conversion/converters.hpp"
#include "conversion/log_files.hpp"
#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/datasets/scan_pairer.hpp"
#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/datasets/tum.hpp"

namespace pcrb_tools {

/// What places the scans of a log.
struct KaistFrames {
  pcrb::Transform T_vehicle_left;
  pcrb::Transform T_vehicle_right;
  pcrb::Trajectory trajectory;
};

/// Reads them from the files that the request names, else from the log.
/// @param log  may be null
KaistFrames readFrames(const KaistRequest& request, const LogFiles* log);

/// Whether a file is wanted by readFrames.
bool isFrameFile(const LogFile& file);

/// Decides which scans of a KAIST log become clouds, and with which poses: the same for logs, bags
/// and live topics.
class KaistScanSelector {
 public:
  struct Pair {
    std::string cloud_name;
    pcrb::Transform T_world_vehicle_left;
    pcrb::Transform T_world_vehicle_right;
    std::string origin;  ///< poses and options, for fingerprints
  };

  /// All must outlive it.
  KaistScanSelector(const KaistFrames& frames, const KaistRequest& request,
                    const std::string& sequence, Conversion& conversion);

  /// How the cloud of two scans is made, or nothing: then it was dropped with the reason. Only
  /// scans with poses and a partner count against the rate. A left scan that comes again with a
  /// better partner, as its log is played again, replaces its earlier cloud.
  std::optional<Pair> select(pcrb::Stamp left, std::optional<pcrb::Stamp> right);

 private:
  /// Why a pair with poses becomes no cloud; null if it does.
  const char* refuse(pcrb::Stamp left, pcrb::Stamp right);

  const KaistFrames& frames_;
  const KaistRequest& request_;
  std::string sequence_;
  Conversion& conversion_;
  pcrb::RateLimiter limiter_;
  pcrb::StreamClock clock_;
  std::map<pcrb::Stamp, pcrb::Stamp> partners_;  ///< right scans of the admitted left ones
};

/// The cloud of two scans.
ConvertedScan mergePair(const KaistFrames& frames, const KaistScanSelector::Pair& pair,
                        pcrb::SensorScan left, pcrb::SensorScan right);

/// The sequence's name: as asked, or `urbanNN` from a path.
/// @throws InvalidParameter  if neither gives one.
std::string kaistSequence(const KaistRequest& request, const std::string& path);

/// Makes clouds of two streams of messages, from a bag or live.
class KaistStream {
 public:
  using Message = sensor_msgs::PointCloud2::ConstPtr;

  /// Frames, request and conversion must outlive it and its clouds.
  /// @param identity  of the streams, for fingerprints
  KaistStream(const KaistFrames& frames, const KaistRequest& request, const std::string& sequence,
              const std::string& identity, Conversion& conversion);

  void addLeft(const Message& message);
  void addRight(const Message& message);

  /// Converts what still waits for a partner.
  void finish();

 private:
  using Pairer = pcrb::ScanPairer<Message>;

  void convert(const std::vector<Pairer::Pair>& pairs);

  const KaistFrames& frames_;
  const KaistRequest& request_;
  std::string identity_;
  Conversion& conversion_;
  KaistScanSelector selector_;
  Pairer pairer_;
};

}  // namespace pcrb_tools
