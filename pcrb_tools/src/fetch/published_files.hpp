#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "fetch/sources.hpp"

namespace pcrb_tools {

/// Makes sure that a file is what its source says: of the right size where that is known, and whole
/// and readable as what it is. A page of HTML with a good name is not.
///
/// @param bytes  its size, where known
/// @throws pcrb::Error  naming the file, what was found and what was expected.
void requireContent(const Source& source, const std::string& path,
                    const std::optional<std::uint64_t>& bytes);

/// Writes a published file into the common layout, with its folders; one that is there with the
/// same bytes is left alone.
///
/// @param origin       of the bytes, for messages.
/// @param may_replace  a file that is something else; else it may be the user's own.
/// @throws pcrb::InvalidFile  if the path is something else already, or cannot be written.
void putPublishedFile(const std::string& path, std::string_view bytes, const std::string& origin,
                      bool may_replace);

/// Unpacks the `.pcd` files of an archive into a folder, all into the one folder.
///
/// Of an entry's name only the last part is used; entries of other kinds and links are passed over.
/// What was unpacked is recorded in `<archive>.unpacked`: an archive that was unpacked completely,
/// into files that are unchanged, is not unpacked again. A file gets its name only after it has
/// been read as a cloud.
///
/// @param sha256    of the archive.
/// @param force     replace clouds that are something else and were not unpacked from this archive.
/// @param on_cloud  called after each file.
/// @return          number of clouds.
/// @throws pcrb::InvalidFile  if the archive is damaged or hostile, an entry is no cloud or would
///                            replace something else, two have one name, or there is no cloud.
std::size_t unpackClouds(const std::string& archive, const std::string& sha256,
                         const std::string& folder, bool force = false,
                         const std::function<void()>& on_cloud = {});

}  // namespace pcrb_tools
