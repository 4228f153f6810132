#pragma once

#include <string>

namespace pcrb {

/// Name of the tool that drew a problem file, as its side file `<problem file>.yaml` says.
///
/// @param hash  fileHash() of the problem file.
/// @return      empty where there is no side file, or where it is not of a file with this hash:
///              then the problems are somebody else's, such as the published ones.
/// @throws InvalidFile  if the side file is there and cannot be read.
std::string toolThatDrew(const std::string& problem_file, const std::string& hash);

}  // namespace pcrb
