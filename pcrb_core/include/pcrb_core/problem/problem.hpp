#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace pcrb {

enum class Kind { kLocal, kGlobal };

/// `local` or `global`.
const char* toString(Kind kind);

/// @throws InvalidParameter  if the text is neither `local` nor `global`.
Kind kindFromString(const std::string& text);

/// One row of a problem file.
struct Problem {
  std::string id;        ///< official id, decimal digits
  std::string source;    ///< file name in the sequence's folder
  std::string target;    ///< file name in the sequence's folder
  double overlap = 0.0;  ///< fraction of source points with a target point nearby, in [0, 1]
  /// First three rows of the perturbation, in the data set's frame; as in the file, rigid or not.
  Eigen::Matrix<double, 3, 4> perturbation;
};

/// Reads a problem file: header `id source target overlap t1 … t12`, then one row per problem.
///
/// Strict: an id must be 2 to 20 digits (13 or 14 in the published files) and unique, names must be
/// plain file names (no `/`), overlap in [0, 1], twelve finite numbers, at least one row. LF or
/// CRLF.
/// @throws InvalidFile  with file and line, what was found and what was expected.
std::vector<Problem> readProblemFile(const std::string& path);

/// The same from memory; `name` stands for the path in messages.
std::vector<Problem> parseProblemFile(const char* begin, const char* end, const std::string& name);

/// Text of a problem file: overlap with 4 decimals, each transform entry in the shortest form that
/// reads back to the same double (the published files are reproduced byte for byte).
///
/// @throws InvalidProblem  for a row that readProblemFile would refuse.
std::string formatProblemFile(const std::vector<Problem>& problems);

/// Writes formatProblemFile to a temporary name in the same folder, then renames.
///
/// @throws InvalidFile  if the file cannot be written completely.
void writeProblemFile(const std::string& path, const std::vector<Problem>& problems);

/// Id of a problem: the decimal CRC-32 of the sequence name, followed by the zero-padded index.
///
/// @param index  31k + j for the j-th perturbation (0 … 29) of the k-th local pair, 31k + 30 for
///               the k-th global pair.
/// @param pairs  number of pairs in the list; the index has as many digits as 31 · pairs − 1.
/// @throws InvalidParameter  if the index is not below 31 · pairs.
std::string problemId(const std::string& sequence, std::size_t index, std::size_t pairs);

}  // namespace pcrb
