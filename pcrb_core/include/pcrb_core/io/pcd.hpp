#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/io/memory_budget.hpp"
#include "pcrb_core/point_cloud.hpp"

namespace pcrb {

class AtomicFile;

struct PcdReadOptions {
  int threads = 1;  ///< >= 1, for ascii; the result does not depend on it
  /// Of which file and cloud take their share while they are read; what needs more than all of it
  /// is refused before it is there.
  MemoryBudget* budget = &MemoryBudget::ofProcess();
};

/// Reads a PCD file: ascii, binary or binary_compressed; any extra or padding (`_`) fields; SIZE 4
/// and 8 floats; organized or not; CRLF or LF; final newline or not.
///
/// Coordinates are read as double. Points with a NaN or infinite coordinate are left out and
/// counted. The field `intensity` is kept where the file has one; VIEWPOINT becomes `viewpoint`.
/// Memory is bounded by the file's size, whatever its header claims, and by the options. What
/// changes no point is let pass: any order of header entries, missing VERSION, COUNT (1) or
/// VIEWPOINT, empty lines behind the last row, zeros that fill binary data up to a page (old
/// versions of PCL wrote them), any text in a column that is not used; and with a note in the
/// cloud: fields X, Y, Z or Intensity, an intensity of several values (not kept), no HEIGHT, a
/// VIEWPOINT of zeros, blank lines between rows.
///
/// @throws InvalidFile       with file and line, what was found and what was expected.
/// @throws InvalidParameter  if threads < 1.
DatasetCloud readPcd(const std::string& path, const PcdReadOptions& options = {});

/// The same from memory; `name` stands for the path in messages.
DatasetCloud parsePcd(const char* begin, const char* end, const std::string& name,
                      const PcdReadOptions& options = {});

/// Memory that a compressed PCD takes unpacked, with its points twice, as its first 64 KiB say: for
/// who takes a share of a budget before he reads it.
///
/// @return  bytes; 0 for all else, which takes no more than some times its size, and for what is no
///          PCD: who reads it says so
std::size_t memoryOfPackedPcd(std::string_view start);

/// The same of a file; 0 if it cannot be read.
std::size_t memoryOfPackedPcdFile(const std::string& path);

/// Seconds of a unit of a field that holds the time of each point, as drivers call it: `time`, `t`,
/// `timestamp`, `time_stamp`, `offset_time`, `time_offset`, `point_time`: floats are seconds,
/// integers nanoseconds.
/// @return  0 for other names
double pointTimeScale(std::string_view field, bool is_float);

/// A cloud with the times of its points, from the first field that pointTimeScale() knows.
struct TimedCloud : DatasetCloud {
  std::vector<double> times;  ///< s, one per point, or empty where there is no such field
};

/// parsePcd() with the times of the points.
TimedCloud parseTimedPcd(const char* begin, const char* end, const std::string& name,
                         const PcdReadOptions& options = {});

/// The VIEWPOINT of a PCD file, as DatasetCloud::hasViewpoint() has it; nothing where it is
/// unknown. Reads the header only.
///
/// @throws InvalidFile  for a header that readPcd() would refuse.
std::optional<Transform> readViewpoint(const std::string& path);

/// Writes ASCII PCD v0.7, fields x y z (SIZE 4 4 4, TYPE F F F), each coordinate in the shortest
/// form that reads back to the same double, VIEWPOINT = translation and quaternion (w x y z) of
/// `viewpoint`.
///
/// Writes to a temporary name in the same folder, then renames. Intensity is not written.
/// @throws InvalidFile  if the file cannot be written completely, or a point is not finite.
void writePcd(const std::string& path, const DatasetCloud& cloud);

/// The same into a file whose commit is left to the caller, who may have other things to do while
/// the disk takes it.
///
/// @param path  for messages
void writePcd(AtomicFile& file, const std::string& path, const DatasetCloud& cloud);

/// Order of file names as a person counts: runs of digits compare as numbers, so `PointCloud2.pcd`
/// comes before `PointCloud10.pcd`. Names that differ in leading zeros only compare as text.
bool naturalLess(const std::string& left, const std::string& right);

/// Names of the `.pcd` files in a folder (hidden ones left out), in natural order.
///
/// @throws InvalidFile  if the path is no readable folder.
std::vector<std::string> findClouds(const std::string& folder);

}  // namespace pcrb
