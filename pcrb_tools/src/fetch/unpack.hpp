#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace pcrb_tools {

/// Unpacks the `.pcd` files of an archive into a folder, all into the one folder.
///
/// Of an entry's name only the last part is used; entries of other kinds and links are passed over.
/// What was unpacked is listed in `<archive>.unpacked`: an archive that was unpacked completely,
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
