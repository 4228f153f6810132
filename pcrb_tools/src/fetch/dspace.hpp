#pragma once

#include <functional>
#include <string>

#include "fetch/download.hpp"
#include "fetch/sources.hpp"

namespace pcrb_tools {

/// Finds a file in an item of a DSpace 7 repository by its name: where it can be downloaded, its
/// size and its MD5, as the repository's REST interface says.
///
/// @param place    with dspace_item; its url is the interface's root, `https://…/server/api`
/// @param scratch  path that answers are put down at for a moment
/// @return         a place with url, bytes and md5
/// @throws pcrb::InvalidFile  for answers of another form; if the item has no such file, naming
///                            those it has.
Place findInDspace(const Place& place, const std::string& scratch, const DownloadPolicy& policy);

/// The same with the repository's answers by their addresses, whatever they hold.
Place findInDspace(const Place& place, const std::function<std::string(const std::string&)>& get);

/// @throws pcrb::InvalidFile  if a file's MD5 is not the expected one.
void requireMd5(const std::string& path, const std::string& expected);

}  // namespace pcrb_tools
