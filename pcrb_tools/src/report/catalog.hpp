#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace pcrb_tools {

/// Place of a sequence in the paper's tables; those that are not in them come after all that are.
std::size_t publishedPlace(const std::string& sequence);

/// Data sets by their sequences: those of the paper, and of the problem files below `root`.
///
/// @param root  empty = only what is built in.
/// @throws pcrb::InvalidFile  if the root is no readable folder.
std::map<std::string, std::string> knownSequences(const std::string& root);

/// Whether a sequence of that name in that data set is one of the paper's, and how many these are.
bool isInPaper(const std::string& data_set, const std::string& sequence);
std::size_t paperSequenceCount();

/// What a sequence has in common with others, to group results by: environment and structure of the
/// paper's sequences (this suite's own assignment), sensor and characteristics of its data set
/// (`dataset.yaml` below `root`).
///
/// @param root  empty = only what is built in.
std::vector<std::string> characteristicsOf(const std::string& root, const std::string& data_set,
                                           const std::string& sequence);

}  // namespace pcrb_tools
