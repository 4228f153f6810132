#pragma once

#include <string>
#include <vector>

#include "pcrb_core/problem/dataset.hpp"

namespace pcrb_tools {

/// The folder of a sequence's clouds, `<root>/<data set>/<sequence>`.
struct SequenceFolder {
  std::string path;  ///< absolute, without a slash at the end
  std::string root;  ///< absolute
  std::string data_set;
  std::string sequence;
  std::vector<std::string> clouds;  ///< file names in natural order

  /// Path of a cloud.
  std::string cloud(const std::string& name) const { return path + "/" + name; }

  /// Path of a file of the data set, beside the sequence's folder.
  std::string sibling(const std::string& name) const { return root + "/" + data_set + "/" + name; }
};

/// @throws pcrb::InvalidFile  if the folder cannot be listed, has no clouds, or is not two levels
///                            below a root.
SequenceFolder openSequenceFolder(const std::string& path);

/// Takes clouds out of the list.
/// @throws pcrb::InvalidParameter  if one of the names is no cloud of the folder.
void exclude(SequenceFolder& folder, const std::vector<std::string>& names);

/// Position of a cloud in the folder's list.
/// @throws pcrb::InvalidParameter  if it is no cloud of the folder.
std::size_t positionOf(const SequenceFolder& folder, const std::string& name);

/// The original log of a sequence, as the data set's converter takes it.
struct SequenceLog {
  std::string data_set;  ///< eth, planetary, tum or kaist
  std::string sequence;
  std::vector<std::string> inputs;  ///< folders, archives and bags
};

/// A problem file in the common layout.
struct ProblemFilePath {
  std::string root;  ///< absolute
  pcrb::SequenceFiles files;
};

/// @param path  `<root>/<data set>/<sequence>_<kind>.txt`
/// @throws pcrb::InvalidFile  if it is no such file.
ProblemFilePath splitProblemFilePath(const std::string& path);

}  // namespace pcrb_tools
