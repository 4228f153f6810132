#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "pcrb_core/datasets/tum.hpp"

namespace pcrb_tools {

/// A decoded depth image.
struct DepthPng {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string pixels;  ///< 16 bits each, big-endian as in the file

  /// A view of the pixels, which must outlive it.
  pcrb::DepthImage view(double units_per_metre) const;
};

/// Decodes a PNG with 16 bits of grey.
/// @param name  stands for the path in messages
/// @throws InvalidFile  if it is damaged, of another kind, or larger than 8192 pixels a side.
DepthPng decodeDepthPng(std::string_view bytes, const std::string& name);

}  // namespace pcrb_tools
