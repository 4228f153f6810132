#pragma once

#include <string>
#include <string_view>

namespace pcrb {

/// Makes sure that binary data is not what a download or a clone leaves in its place; texts are
/// looked at by LineReader.
///
/// @param start  the first bytes at least
/// @throws InvalidFile  for an HTML page or a Git LFS pointer.
void requireData(std::string_view start, const std::string& name);

}  // namespace pcrb
