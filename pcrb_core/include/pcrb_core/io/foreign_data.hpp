#pragma once

#include <string>
#include <string_view>

namespace pcrb {

/// Makes sure that binary data is not what a download or a clone leaves in its place; texts are
/// looked at by LineReader.
///
/// @param start  the first bytes at least
/// @throws InvalidFile  for a page of HTML or XML, a Git LFS pointer or an archive.
void requireData(std::string_view start, const std::string& name);

/// The same of a file that may be an archive, but not empty.
void requireDataFile(const std::string& path);

}  // namespace pcrb
