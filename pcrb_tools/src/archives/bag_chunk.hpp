#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pcrb_tools {

/// What a packed chunk of a bag holds: unpacked by what rosbag unpacks it with, to the same bytes.
///
/// @param compression  as the chunk's header names it
/// @param size         of what the chunk holds, bytes, as its header says
/// @throws rosbag::BagException  if the compression is unknown, the chunk is damaged, or it holds
///                               another number of bytes.
std::string unpackChunk(std::string_view compression, std::string_view packed, std::size_t size);

}  // namespace pcrb_tools
