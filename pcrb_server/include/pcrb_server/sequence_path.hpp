#pragma once

#include <string>

namespace pcrb {

/// Folder of a sequence's clouds.
///
/// @param word  `data_set/sequence`, or the sequence where only one data set has one of that name.
/// @throws InvalidParameter  if there is none, or more than one (naming them).
std::string findSequenceFolder(const std::string& root, const std::string& word);

}  // namespace pcrb
