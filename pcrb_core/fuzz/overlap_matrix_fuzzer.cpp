#include <cstddef>
#include <cstdint>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const char* const begin = reinterpret_cast<const char*>(data);
  try {
    const auto matrix = pcrb::parseOverlapMatrix(begin, begin + size, "fuzz.txt");
    if (matrix.values.size() != matrix.names.size() * matrix.names.size()) __builtin_trap();
  } catch (const pcrb::InvalidFile&) {
  }
  return 0;
}
