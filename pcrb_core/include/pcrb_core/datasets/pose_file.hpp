#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/datasets/trajectory.hpp"

namespace pcrb {

/// The text formats of trajectories that are in use.
enum class PoseFormat {
  kTum,    ///< `timestamp tx ty tz qx qy qz qw`, seconds
  kKitti,  ///< the first three rows of a 4 × 4 matrix a line, perhaps behind a number; no
           ///< timestamps
  kEuroc,  ///< `timestamp,px,py,pz,qw,qx,qy,qz,…`, nanoseconds
  kKaist,  ///< `timestamp,r00,r01,r02,tx,…,tz`, nanoseconds
  kLog,    ///< 3DMatch's and Redwood's `.log`: `i i n`, then the four rows of a matrix
  kCsv     ///< commas below a row of names
};

/// `tum`, `kitti`, `euroc`, `kaist`, `log`, `csv`.
const char* toString(PoseFormat format);

/// What ties a pose of a file to a scan.
enum class PoseKey { kStamp, kIndex, kName };

/// A pose of a file, T_world_body, with the key that the file has.
struct FilePose {
  Stamp stamp = 0;        ///< kStamp
  std::size_t index = 0;  ///< kIndex: from 0
  std::string name;       ///< kName: of the scan's file
  Transform T_world_body = Transform::Identity();
};

/// The poses of a text, in its order.
struct PoseFile {
  PoseFormat format = PoseFormat::kTum;
  PoseKey key = PoseKey::kStamp;
  std::vector<FilePose> poses;
  std::vector<std::string> notes;  ///< what was concluded, e.g. a unit from the timestamps' size

  /// Poses with the key of a later one, which counts.
  std::size_t duplicates() const;

  /// In time.
  /// @throws InvalidFile  where they have no timestamps; `name` stands for the path.
  Trajectory trajectory(const std::string& name) const;
};

/// Reads a text of poses in any PoseFormat, found by its first rows where none is given: by commas,
/// names of columns, and numbers a row. `#` comments and blank lines are passed over.
///
/// Columns of a csv are found by their names, in any case, with or without a unit in brackets or
/// the path of a message before them: `timestamp` (or secs and nsecs), or `frame`, or `file`;
/// x y z; qx qy qz qw, or roll pitch yaw (rad, or `_deg`), or the entries T00 … T23 of a matrix.
/// Timestamps that no unit is said of are seconds, unless their size is that of milli-, micro- or
/// nanoseconds since 1970, which is noted. Quaternions are normalised, rotations of matrices are
/// replaced by the nearest one.
/// @param name  stands for the path in messages
/// @throws InvalidFile  with line, what was found and what was expected.
PoseFile parsePoseFile(std::string_view text, const std::string& name,
                       std::optional<PoseFormat> format = std::nullopt);

/// Poses of a text in time, and what was concluded from it.
struct TrajectoryFile {
  Trajectory trajectory;
  std::vector<std::string> notes;
};

/// parsePoseFile() of a text that must have timestamps.
TrajectoryFile parseTrajectory(std::string_view text, const std::string& name,
                               std::optional<PoseFormat> format = std::nullopt);

}  // namespace pcrb
