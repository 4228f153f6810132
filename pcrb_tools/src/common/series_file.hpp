#pragma once

#include <string>
#include <vector>

namespace pcrb_tools {

/// One run of a series.
struct SeriesRun {
  std::string folder;  ///< relative to the series' folder
  std::string parameter;
  std::string value;
  int trial = 1;
};

/// Name of the file in a series' folder that lists its runs:
/// `folder,parameter,value,trial`, a row each.
constexpr const char* kSeriesFile = "series.csv";

/// The runs that `<folder>/series.csv` lists; none if there is no such file.
/// @throws pcrb::InvalidFile  if it is malformed.
std::vector<SeriesRun> readSeries(const std::string& folder);

/// The text of that file.
std::string formatSeries(const std::vector<SeriesRun>& runs);

/// The first line of a scored sequence's scans.csv, which score_poses writes and the report reads.
constexpr const char* kScansHeader =
    "scan,stamp,error,rotation_error_rad,translation_error_m,error_or_last_pose";

}  // namespace pcrb_tools
