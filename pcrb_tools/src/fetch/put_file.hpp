#pragma once

#include <string>
#include <string_view>

namespace pcrb_tools {

/// Writes a published file into the common layout, with its folders; one that is there with the
/// same bytes is left alone.
///
/// @param origin       of the bytes, for messages.
/// @param may_replace  a file that is something else; else it may be the user's own.
/// @throws pcrb::InvalidFile  if the path is something else already, or cannot be written.
void putPublishedFile(const std::string& path, std::string_view bytes, const std::string& origin,
                      bool may_replace);

}  // namespace pcrb_tools
