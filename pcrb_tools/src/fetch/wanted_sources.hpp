#pragma once

#include <vector>

#include "fetch/fetch_tool.hpp"
#include "fetch/sources.hpp"

namespace pcrb_tools {

/// The files to fetch for what is asked for, in the list's order: those of the wanted sequences,
/// and the logs and clouds of the sequences that these need.
///
/// @throws pcrb::Error  if the list is malformed or a wanted sequence is not in it.
std::vector<Source> findWantedSources(const FetchOptions& options);

}  // namespace pcrb_tools
