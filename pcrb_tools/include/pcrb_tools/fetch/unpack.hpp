#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace pcrb_tools {

/// Unpacks the `.pcd` files of an archive into a folder, all into the one folder.
///
/// Of an entry's name only the last part is used; entries of other kinds and links are passed over.
/// What was unpacked is listed in `<archive>.unpacked`: an archive that was unpacked completely,
/// into files that are still there, is not unpacked again.
///
/// @param sha256    of the archive.
/// @param on_cloud  called after each file.
/// @return          number of clouds.
/// @throws pcrb::InvalidFile  if the archive is damaged, an entry's name points out of it, two
/// entries
///                            have one name, an entry is larger than 4 GB, or there is no cloud.
std::size_t unpackClouds(const std::string& archive, const std::string& sha256,
                         const std::string& folder, const std::function<void()>& on_cloud = {});

}  // namespace pcrb_tools
