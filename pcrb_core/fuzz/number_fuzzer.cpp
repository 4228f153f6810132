#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "pcrb_core/io/number.hpp"

/// The fast paths agree with std::from_chars and std::to_chars to the bit, wherever they stop.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0 && data[0] == '+') return 0;  // the one difference, tested elsewhere
  // Padded: only inside a longer text is the fast path open.
  const std::string text =
      std::string(reinterpret_cast<const char*>(data), size) + std::string(40, ' ');
  const char* const end = text.data() + text.size();
  double expected = 0.0;
  const auto result = std::from_chars(text.data(), end, expected);
  double value = 0.0;
  const char* const behind = pcrb::scanDouble(text.data(), end, value);
  if (behind != (result.ec == std::errc() ? result.ptr : nullptr)) __builtin_trap();
  if (behind == nullptr) return 0;
  if (std::memcmp(&value, &expected, sizeof(value)) != 0) __builtin_trap();
  char shortest[64];
  char* const last = std::to_chars(shortest, shortest + sizeof(shortest), value).ptr;
  if (pcrb::formatShortest(value) != std::string(shortest, last)) __builtin_trap();
  return 0;
}
