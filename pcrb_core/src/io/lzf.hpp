#pragma once

#include <cstddef>
#include <string_view>

namespace pcrb {

/// Most bytes that one byte of LZF data can stand for: 264 from 3.
constexpr std::size_t kLzfLargestRatio = 88;

/// Decodes LZF data (the compression of binary_compressed PCD files) of exactly `size` bytes.
///
/// @return  whether the data is well-formed and gives that size; `output` has room for it.
bool decodeLzf(std::string_view input, char* output, std::size_t size);

}  // namespace pcrb
