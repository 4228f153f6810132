#pragma once

#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/run/offline_run.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb_tools {

/// Where the poses to score are.
struct PoseSource {
  std::string path;                          ///< a bag (`.bag`), or a text of poses
  std::string topic;                         ///< of a bag
  std::string map_frame = "map";             ///< in which the poses of a bag must be
  std::optional<pcrb::PoseFormat> format{};  ///< of a sequence's text; nothing = by its rows
};

/// What `score_poses PROBLEM_FILE` is asked for.
struct ProblemScoringOptions {
  PoseSource poses;
  std::string problem_file;  ///< `<root>/<data set>/<sequence>_<kind>.txt`
  std::string run;           ///< folder of the results
  std::string key;           ///< of a bag of problems; empty = official ids, registration
  pcrb::PoseFrame pose_frame = pcrb::PoseFrame::kDataset;  ///< without key
  std::size_t subset = 0;                                  ///< without key
  std::uint64_t seed = 1;                                  ///< without key, of the subset
};

/// Scores the poses of problems into a run like the server's, and prints its summary.
///
/// @throws pcrb::Error  for files that are not as they should be, a pose of no problem, or two
///                      poses of one problem in a text; of a bag the last one counts.
void runProblemScoring(const ProblemScoringOptions& options, std::ostream& out);

/// What `score_poses --sequence` is asked for.
struct TrackingOptions {
  PoseSource poses;
  std::string folder;  ///< `<root>/<data set>/<sequence>`
  std::string scans;   ///< list of sequence_to_bag or replay; empty = stamps are in the clouds'
                       ///< names and poses in the clouds' frame
  std::string output;  ///< folder of the results
  double max_difference = 0.01;  ///< s between a scan and its pose
  std::size_t delta = 1;         ///< scans, of relative errors
  double metres = 1.0;           ///< m, of relative errors
  double max_lost = 0.0;         ///< fraction of the scans that may be without a pose
  bool align = false;            ///< APE after a rigid alignment
  pcrb::Transform T_body_sensor = pcrb::Transform::Identity();  ///< poses are those of the body
  std::vector<std::string> tf;  ///< of a bag: world's and body's frames, in place of a topic
  double time_offset = 0.0;     ///< s, added to the stamps of the poses
  double largest_offset = 0.0;  ///< s: further offset to estimate, at most so large; 0 = none
};

/// Scores a trajectory, a text in any pcrb::PoseFormat or of a bag, scan by scan: the benchmark's
/// error, APE, RPE over scans and metres, KITTI's drift. A scan without a pose is lost, and costs:
/// it counts with the last pose before it, or with that of the first scan. Writes scans.csv,
/// summary.txt, truth.tum, estimate.tum and map.csv (what the scans show, from above), and prints
/// the summary.
///
/// @return  whether no more scans were lost than may be.
/// @throws pcrb::Error  for files that are not as they should be, or if no scan has a pose.
bool runTrackingScoring(const TrackingOptions& options, std::ostream& out);

}  // namespace pcrb_tools
