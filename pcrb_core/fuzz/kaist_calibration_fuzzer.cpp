#include <cstddef>
#include <cstdint>

#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const pcrb::Transform T =
        pcrb::parseKaistCalibration({reinterpret_cast<const char*>(data), size}, "fuzz.txt");
    if (!T.matrix().allFinite()) __builtin_trap();
  } catch (const pcrb::Error&) {
  }
  return 0;
}
