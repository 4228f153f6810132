#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pcrb {

/// Memory that a compressed PCD takes unpacked, with its points twice, as its first 64 KiB say: for
/// who takes a share of a budget before he reads it.
///
/// @return  bytes; 0 for all else, which takes no more than some times its size, and for what is no
///          PCD: who reads it says so
std::size_t memoryOfPackedPcd(std::string_view start);

/// The same of a file; 0 if it cannot be read.
std::size_t memoryOfPackedPcdFile(const std::string& path);

}  // namespace pcrb
