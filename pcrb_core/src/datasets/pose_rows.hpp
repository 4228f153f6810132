#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {

/// Words of a line, by commas if it has any.
std::vector<std::string_view> wordsOf(std::string_view line);

/// A row for a message.
std::string quoted(const std::vector<std::string_view>& words, std::string_view line);

/// What to say of a row with the separators of a spreadsheet in other languages than English.
std::string adviceOnSeparators(std::string_view line);

/// The numbers of `count` words from one on.
/// @throws InvalidFile  for the reader's line if one is no finite number.
std::vector<double> requireFinite(const LineReader& reader,
                                  const std::vector<std::string_view>& words, std::size_t first,
                                  std::size_t count, const std::string& expected);

/// The pose of a quaternion, which is normalised.
/// @throws InvalidFile  for the reader's line if its norm is far from 1.
Transform requireQuaternionPose(const LineReader& reader, const Eigen::Vector3d& translation,
                                const Eigen::Quaterniond& rotation);

/// The pose of 12 or 16 row-major numbers, with the nearest rotation.
/// @throws InvalidFile  for the reader's line if they are no pose.
Transform requireMatrixPose(const LineReader& reader, const std::vector<double>& numbers);

/// ns in the unit of a timestamp that none is said of: what its size tells, seconds otherwise.
/// @param notes  another unit than seconds is noted.
Stamp unitBySize(std::string_view timestamp, std::vector<std::string>& notes);

/// A timestamp of some unit, exactly.
/// @param unit  ns, a power of ten
/// @throws InvalidFile  for the reader's line if it is none.
Stamp requireStamp(const LineReader& reader, std::string_view word, Stamp unit);

/// Whether a line, perhaps a comment, names the columns of poses.
bool hasPoseColumns(std::string_view line);

/// Reads a csv with named columns: key and poses.
/// @throws InvalidFile  with line, what was found and what was expected.
void readPoseColumns(std::string_view text, const std::string& name, PoseFile& file);

}  // namespace pcrb
