#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb_tools {

/// A scan of a sequence, and where a tracker thought it was.
struct TrackedScan {
  std::string name;
  pcrb::Stamp stamp = 0;
  pcrb::Transform truth = pcrb::Transform::Identity();  ///< T_map_sensor
  std::optional<pcrb::Transform> T_map_sensor;          ///< estimated; nothing = no pose
  std::optional<pcrb::PoseError> error;
};

/// One line per scan; without a pose its fields are empty.
std::string formatScansCsv(const std::vector<TrackedScan>& scans);

/// TUM's format, which evo reads: `timestamp tx ty tz qx qy qz qw`, the truth of the scans that
/// have a pose, or their poses.
std::string formatTruthTum(const std::vector<TrackedScan>& scans);
std::string formatEstimateTum(const std::vector<TrackedScan>& scans);

/// A table: the benchmark's error, APE and RPE with evo's statistics.
///
/// @throws pcrb::InvalidParameter  if no scan has a pose, or the alignment is not determined.
std::string summarizeTracking(const std::vector<TrackedScan>& scans, std::size_t delta, bool align);

}  // namespace pcrb_tools
