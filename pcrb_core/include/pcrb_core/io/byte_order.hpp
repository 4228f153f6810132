#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace pcrb {

/// An unsigned integer of eight bytes at most, on any processor.
inline std::uint64_t loadUnsigned(const char* bytes, std::size_t size, bool is_big_endian = false) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i != size; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes[is_big_endian ? i : size - 1 - i]);
  }
  return value;
}

/// A float32 or float64, on any processor.
template <typename Float>
Float loadFloat(const char* bytes, bool is_big_endian = false) {
  using Bits = std::conditional_t<sizeof(Float) == 4, std::uint32_t, std::uint64_t>;
  const auto bits = static_cast<Bits>(loadUnsigned(bytes, sizeof(Float), is_big_endian));
  Float value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

}  // namespace pcrb
