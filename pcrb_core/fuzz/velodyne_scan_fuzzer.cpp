#include <cstddef>
#include <cstdint>

#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const auto origin : {pcrb::OriginPoints::kKeep, pcrb::OriginPoints::kDrop}) {
    try {
      const pcrb::SensorScan scan = pcrb::parseVelodyneScan(bytes, origin, "fuzz.bin");
      if (scan.points.size() != scan.counts.written()) __builtin_trap();
    } catch (const pcrb::Error&) {
    }
  }
  return 0;
}
