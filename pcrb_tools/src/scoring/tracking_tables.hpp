#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/evaluation/trajectory_error.hpp"
#include "pcrb_core/transform.hpp"
#include "scoring/scoring_tool.hpp"

namespace pcrb_tools {

/// A scan of a sequence, and where a tracker thought it was.
struct TrackedScan {
  std::string name;
  pcrb::Stamp stamp = 0;
  pcrb::Transform truth = pcrb::Transform::Identity();  ///< T_map_sensor
  std::optional<pcrb::Transform> T_map_sensor;          ///< estimated; nothing = no pose
  std::optional<pcrb::PoseError> error;
  double held_error = 0.0;  ///< of the pose, or without one of the last pose before it
};

/// Of the scans that have one.
struct Matched {
  pcrb::Poses truth;
  pcrb::Poses estimate;
  std::vector<double> errors;
  std::vector<double> held_errors;  ///< of all scans
};

Matched match(const std::vector<TrackedScan>& scans);

/// One line per scan; without a pose its fields are empty.
std::string formatScansCsv(const std::vector<TrackedScan>& scans);

/// TUM's format, which evo reads, of the scans that have a pose.
std::string formatTruthTum(const std::vector<TrackedScan>& scans);
std::string formatEstimateTum(const std::vector<TrackedScan>& scans);

/// Whether no more scans are without a pose than may be.
bool isComplete(const std::vector<TrackedScan>& scans, const TrackingOptions& options);

/// A table: the benchmark's error, APE and RPE with evo's statistics; the verdict on completeness.
std::string summarizeTracking(const std::vector<TrackedScan>& scans,
                              const TrackingOptions& options);

}  // namespace pcrb_tools
