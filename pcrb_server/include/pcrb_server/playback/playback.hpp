#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_server/playback/scene.hpp"

namespace pcrb {

/// Something that is replayed scene by scene.
class Playback {
 public:
  virtual ~Playback() = default;

  virtual std::size_t size() const = 0;

  /// The next scene; after the last one the first again, as if nothing had been shown before.
  ///
  /// @param stamp  of all its messages; later than that of the scene before.
  /// @throws Error  if a cloud cannot be read or shown.
  virtual Scene next(const ros::Time& stamp) = 0;
};

/// A sequence: its clouds in natural order, where the sensor was, and a map.
struct SequenceOptions {
  std::string folder;                 ///< `<root>/<data set>/<sequence>`
  std::string map_file;               ///< a cloud in the same frame; empty = a map that grows
  double map_leaf = 0.0;              ///< m, edge of a voxel of the growing map; 0 = the data set's
  std::size_t map_points = 200000;    ///< limit of the growing map, > 0
  std::vector<std::string> excluded;  ///< file names that are no scans, e.g. a map in the folder
  bool truth = true;  ///< false: what a node under test may see: the scan in its sensor's frame,
                      ///< the map file, and the initial pose with the first scan
  std::string map_frame = "map";
  std::string scan_frame = "pcrb_scan";  ///< of the scan without truth
};

/// @throws Error  if the folder, a name or the map is wrong, or, without truth, if the first cloud
///                has no viewpoint.
std::unique_ptr<Playback> playSequence(const SequenceOptions& options);

/// Registration problems.
struct ProblemsOptions {
  std::string root;
  std::vector<std::string> sequences;  ///< as `sequences` of benchmark_server
  std::vector<Kind> kinds;
  PresentationKind presentation = PresentationKind::kRegistration;
  bool truth = true;   ///< false: the same that a client of the server sees, in a secret order
  std::string secret;  ///< 32 hexadecimal digits; needed without truth and for localization
  bool upright = false;
  int subset = 0;            ///< number of problems drawn, 0 = all
  int seed = 1;              ///< of that draw
  double time_limit = 10.0;  ///< s, as the problems state it
  std::string map_frame = "map";
  std::string scan_frame = "pcrb_scan";
};

std::unique_ptr<Playback> playProblems(const ProblemsOptions& options);

/// A finished or interrupted run: the results that it has.
struct RunOptions {
  enum class Order { kFinished, kWorst, kBest };

  std::string run;
  std::string root;                    ///< empty = the one that the run used
  std::vector<std::string> sequences;  ///< as `sequences` of benchmark_server
  Order order = Order::kFinished;
  std::string map_frame = "map";
};

/// @throws Error  if there is no result, or the data below the root are not those of the run.
std::unique_ptr<Playback> playRun(const RunOptions& options);

}  // namespace pcrb
