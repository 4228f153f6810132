#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/run/run_info.hpp"
#include "pcrb_server/playback/scene.hpp"

namespace pcrb {

/// Something that is replayed scene by scene.
class Playback {
 public:
  virtual ~Playback() = default;

  virtual std::size_t size() const = 0;

  /// s by which the first messages of the next scene are due before its stamp.
  virtual double lead() const { return 0.0; }

  /// The next scene; after the last one the first again, as if nothing had been shown before.
  ///
  /// @param stamp  of all its messages; later than that of the scene before.
  /// @throws Error  if a cloud cannot be read or shown.
  virtual Scene next(const ros::Time& stamp) = 0;

  /// Makes the scene of a position, below size(), the next one.
  virtual void seek(std::size_t position) = 0;
};

/// A sequence: its clouds in natural order, where the sensor was, and a map.
struct SequenceOptions {
  std::string folder;                 ///< `<root>/<data set>/<sequence>`
  std::string map_file;               ///< a cloud in the same frame; empty = a map that grows
  double map_leaf = 0.0;              ///< m, edge of a voxel of the growing map; 0 = the data set's
  std::size_t map_points = 200000;    ///< limit of the growing map, > 0
  std::vector<std::string> excluded;  ///< file names that are no scans, e.g. a map in the folder
  /// false: what a node under test may see: the scan in its sensor's frame, the map file, and the
  /// initial pose with the first scan.
  bool publish_ground_truth = true;
  std::string map_frame = "map";
  std::string scan_frame = "pcrb_scan";  ///< of the scan without ground truth

  // Without ground truth, as localization_bridge does:
  std::string base_frame;           ///< parent of scan_frame on tf, as identity; empty = none
  double map_settle = 1.0;          ///< s from the map to the initial pose
  double initialpose_settle = 0.1;  ///< s from the initial pose to the first scan
};

/// The scans of a sequence in the order of its playback: all clouds but those that are none.
/// @throws Error  if the folder or a name is wrong, or there is no scan.
std::vector<std::string> scansOf(const SequenceOptions& options);

/// @throws Error  if the folder, a name or the map is wrong, or, without ground truth, if the
///                first cloud has no viewpoint.
std::unique_ptr<Playback> playSequence(const SequenceOptions& options);

/// Registration problems.
struct ProblemsOptions {
  std::vector<std::string> ids;    ///< official ids of those that are shown; empty = all
  RunConfiguration configuration;  ///< which problems, and how they are posed
  /// false: the same that a client of the server sees, in a secret order.
  bool publish_ground_truth = true;
  std::optional<Secret> secret;  ///< needed without ground truth and for localization
  std::string map_frame = "map";
  std::string scan_frame = "pcrb_scan";

  /// Whether anything that is shown is derived from a secret.
  bool needsSecret() const {
    return !publish_ground_truth || configuration.presentation.isLocalization();
  }
};

/// @throws InvalidParameter  if there is no secret where one is needed, or no problem of the ids.
std::unique_ptr<Playback> playProblems(const ProblemsOptions& options);

/// A finished or interrupted run: the results that it has.
struct RunOptions {
  enum class Order { kFinished, kWorst, kBest };

  std::string run;
  std::string root;                    ///< empty = the one that the run used
  std::vector<std::string> sequences;  ///< as `sequences` of benchmark_server
  std::optional<Kind> kind;            ///< none = both
  std::vector<std::string> ids;        ///< official ids of problems; empty = all
  Order order = Order::kFinished;
  std::string map_frame = "map";
};

/// @throws Error  if there is no result, or the data below the root are not those of the run.
std::unique_ptr<Playback> playRun(const RunOptions& options);

}  // namespace pcrb
