#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcrb_core/evaluation/trajectory_error.hpp"
#include "report/table.hpp"

namespace pcrb_tools {

/// One scan of a tracker's sequence.
struct TrackerScan {
  std::string name;
  double time = 0.0;            ///< s since the first scan
  std::optional<double> error;  ///< nothing where the scan was lost
  double held_error = 0.0;      ///< that of the last pose before it, for a lost scan
};

/// What `score_poses --sequence` wrote about one tracker.
struct Tracker {
  std::string name;
  std::string folder;
  std::vector<TrackerScan> scans;
  pcrb::Poses truth;                           ///< of the scans that are not lost
  pcrb::Poses estimate;                        ///< of the same
  std::vector<std::pair<double, double>> map;  ///< x, y, m: squares that the scans show

  double completeness() const {
    return static_cast<double>(truth.size()) / static_cast<double>(scans.size());
  }
};

/// Reads output folders of `score_poses --sequence`.
///
/// @param folders  each `FOLDER` or `NAME=FOLDER`.
/// @throws pcrb::Error  for a file that is missing or malformed, or two trackers of one name.
std::vector<Tracker> loadTrackers(const std::vector<std::string>& folders);

/// One row per tracker: lost scans and what they cost, APE, RPE over scans and metres, KITTI's
/// drift.
Table trackerTable(const std::vector<Tracker>& trackers);

/// `groups`, of trackers that had the same scans: `trackers` (names), `map` and `truth` (x, y),
/// and per tracker its `path` (x, y) and `errors` (time, error, null where lost).
Json trackerCharts(const std::vector<Tracker>& trackers);

}  // namespace pcrb_tools
