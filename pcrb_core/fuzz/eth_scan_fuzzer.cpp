#include <cstddef>
#include <cstdint>

#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const pcrb::SensorScan scan =
        pcrb::parseEthScan({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    if (scan.points.size() != scan.counts.written()) __builtin_trap();
  } catch (const pcrb::Error&) {
  }
  return 0;
}
