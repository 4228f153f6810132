#pragma once

#include <string>

#include "pcrb_core/problem/dataset.hpp"

namespace pcrb_tools {

/// A problem file in the common layout.
struct ProblemFilePath {
  std::string root;  ///< absolute
  pcrb::SequenceFiles files;
};

/// @param path  `<root>/<data set>/<sequence>_<kind>.txt`
/// @throws pcrb::InvalidFile  if it is no such file.
ProblemFilePath splitProblemFilePath(const std::string& path);

}  // namespace pcrb_tools
