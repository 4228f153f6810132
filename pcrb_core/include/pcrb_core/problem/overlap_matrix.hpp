#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pcrb {

/// Overlaps of the clouds of a sequence: row = source, column = target.
struct OverlapMatrix {
  std::vector<std::string> names;  ///< file names of the clouds, of rows and columns alike
  std::vector<double> values;      ///< row by row; in [0, 1], or NaN where it was not computed

  /// A matrix that knows only that every cloud overlaps wholly with itself.
  explicit OverlapMatrix(std::vector<std::string> cloud_names = {});

  double& at(std::size_t source, std::size_t target) {
    return values[source * names.size() + target];
  }
  double at(std::size_t source, std::size_t target) const {
    return values[source * names.size() + target];
  }
};

/// Reads the published text format: header `overlap name name …`, then one row per source, `name
/// value value …`, in the header's order.
///
/// Values are in [0, 1] or `nan`; names are unique plain file names. LF or CRLF. Memory is bounded
/// by the file's size.
/// @throws InvalidFile  with file and line, what was found and what was expected.
OverlapMatrix readOverlapMatrix(const std::string& path);

/// The same from memory; `name` stands for the path in messages.
OverlapMatrix parseOverlapMatrix(const char* begin, const char* end, const std::string& name);

/// The text of a matrix; values in the shortest form that reads back to the same double, 0 and 1 as
/// `0.0` and `1.0` like the published files.
std::string formatOverlapMatrix(const OverlapMatrix& matrix);

/// Writes formatOverlapMatrix to a temporary name in the same folder, then renames.
/// @throws InvalidFile  if the file cannot be written completely.
void writeOverlapMatrix(const std::string& path, const OverlapMatrix& matrix);

}  // namespace pcrb
