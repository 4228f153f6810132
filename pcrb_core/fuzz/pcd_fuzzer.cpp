#include <cstddef>
#include <cstdint>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"

/// What is accepted keeps the reader's promises: finite points, one intensity each or none.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const char* const begin = reinterpret_cast<const char*>(data);
  try {
    const pcrb::DatasetCloud cloud = pcrb::parsePcd(begin, begin + size, "fuzz.pcd");
    for (const auto& point : cloud.points) {
      if (!point.allFinite()) __builtin_trap();
    }
    if (!cloud.intensity.empty() && cloud.intensity.size() != cloud.points.size()) __builtin_trap();
    if (!cloud.viewpoint.matrix().allFinite()) __builtin_trap();
  } catch (const pcrb::InvalidFile&) {
  }
  return 0;
}
