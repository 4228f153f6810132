#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pcrb_tools {

/// What `report` is asked for.
struct ReportOptions {
  std::vector<std::string> runs;      ///< run folders, each `FOLDER` or `NAME=FOLDER`
  std::vector<std::string> imports;   ///< result files of others, each `FILE` or `NAME=FILE`
  std::vector<std::string> trackers;  ///< output folders of `score_poses --sequence`, named alike
  std::string format = "csv";         ///< of the imports: `csv` or `ppcr`
  std::string output;                 ///< folder that is made or added to
  std::string title = "Point cloud registration benchmark";
  std::string root;          ///< data set folder; empty = what each run says, where it is there
  std::string ground_truth;  ///< CSV of evaluate_ground_truth, for floors; empty = none
  /// Registration recall is counted at these translations (m) and rotations (degrees).
  std::vector<std::pair<double, double>> recall_limits{
      {0.1, 1.0}, {0.3, 3.0}, {0.5, 5.0}, {2.0, 5.0}};
  std::size_t resamples = 2000;  ///< of the bootstrap
  std::uint64_t seed = 1;        ///< of the bootstrap
  bool with_components = true;   ///< errors along each axis, for which all clouds are read
  bool draw_figures = true;      ///< PNG and PDF, which take most of the time
};

/// Computes the statistics of runs, writes them to files, and has them drawn.
///
/// Writes `summary.csv`, `report.json`, `report.md`, `report.tex` and `tables/*.csv`; then Python
/// draws `index.html` and `figures/*` from `report.json` alone. The same input gives the same
/// bytes. Tables and figures of a former report in that folder are removed, other files are not.
/// @throws pcrb::Error  if a run or file cannot be read or holds nothing, two runs have the same
///                      name, no ground truth is of a sequence of theirs, an output cannot be
///                      written, or drawing fails.
void runReportTool(const ReportOptions& options);

/// Only what is computed: everything but the page and the figures.
void writeReportData(const ReportOptions& options);

}  // namespace pcrb_tools
