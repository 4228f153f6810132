#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include "simulation/scene.hpp"

namespace pcrb_tools::simulation {

/// How much is simulated. Densities of `large` are those of the sensors.
struct LogSize {
  int eth_scans, eth_lines, eth_beams;
  int planetary_scans, planetary_lines, planetary_beams;
  int tum_clouds;         ///< at 2 Hz, of each sequence
  int tum_image_divisor;  ///< of 640 × 480
  int tum_depth_rate;     ///< Hz, of the raw bag
  int kaist_scans, kaist_columns;
};

/// What the simulated logs depend on, apart from where they are put.
struct LogOptions {
  std::uint64_t seed = 1;
  LogSize size;
  double ground_truth_error = 0.0;  ///< m, length of the error of every pose in the logs
  int threads = 1;                  ///< of one job; they do not change a byte
};

/// A piece of the logs that is made on its own: its bytes do not depend on the others.
struct LogJob {
  std::vector<std::string> files;  ///< below the output folder; they appear when complete
  std::function<void(const std::string& output)> make;
};

/// Error that was added to the ground truth of a cloud, m, world frame.
struct KnownError {
  std::string data_set;
  std::string sequence;
  std::string cloud;  ///< file name in the common layout
  Eigen::Vector3d error;
};

/// All that there is to do for a data set's logs.
struct LogPlan {
  std::vector<LogJob> jobs;
  std::vector<KnownError> errors;
};

LogPlan planEthLogs(const LogOptions& options);
LogPlan planPlanetaryLogs(const LogOptions& options);
LogPlan planTumLogs(const LogOptions& options);
LogPlan planKaistLogs(const LogOptions& options);

/// A scene that is built when a job first wants it.
using LazyScene = std::shared_future<Scene>;
LazyScene lazyScene(SceneDescription (*describe)(std::uint64_t), std::uint64_t seed);

/// Displacement of the ground truth at a time, m: of the given length always, its direction turns
/// steadily (once in about 5 s), so that poses near each other in time are wrong alike and scans
/// are not.
class PoseError {
 public:
  PoseError(std::uint64_t seed, double length);

  Eigen::Vector3d at(double time) const;

 private:
  double length_;
  double azimuth_;
  double elevation_;
};

/// The pose moved by an error in the world frame.
pcrb::Transform displaced(const pcrb::Transform& T_world_sensor, const Eigen::Vector3d& error);

/// Point of a polyline at an arc length in m, with the direction of travel there (rad, in the
/// plane); the line ends at its ends.
struct PathPoint {
  Eigen::Vector3d position;
  double heading;
};
PathPoint followPath(const std::vector<Eigen::Vector3d>& corners, double arc_length);
double pathLength(const std::vector<Eigen::Vector3d>& corners);

/// Arc length of stop `i` of `count` along a path: as far apart as fits, at most `spacing` m.
double stopAt(int i, int count, const std::vector<Eigen::Vector3d>& corners, double spacing);

/// Writes a file below a folder, its folders included; it appears complete or not at all.
void writeLogFile(const std::string& output, const std::string& file, const std::string& bytes);

/// What make_sample_logs is asked for.
struct SampleLogsRequest {
  std::string output;
  std::uint64_t seed = 1;
  std::string size = "small";       ///< small, medium or large
  double ground_truth_error = 0.0;  ///< m, >= 0
  std::vector<std::string> data_sets = {"eth", "planetary", "tum", "kaist"};
  int threads = 1;
};

/// The counts of a named size.
/// @throws InvalidParameter  if the name is not small, medium or large.
LogSize logSize(const std::string& name);

/// Simulates the logs of the data sets, each below `<output>/<data set>/` as its archives unpack.
///
/// The same seed, size and error give the same bytes at any number of threads. Files that an
/// earlier, interrupted call with the same settings left are kept; `<output>/sample_logs.txt`
/// remembers the settings, `<output>/ground_truth_error.csv` what was added to the ground truth.
/// @throws InvalidParameter  if a parameter is out of range.
/// @throws InvalidFile       if the folder has other contents, or a file cannot be written; what is
///                           complete stays.
void makeSampleLogs(const SampleLogsRequest& request);

}  // namespace pcrb_tools::simulation
