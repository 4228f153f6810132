#pragma once

#include <Eigen/Core>
#include <string>

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

}  // namespace pcrb
