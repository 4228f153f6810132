#include <cstddef>
#include <cstdint>

#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/datasets/planetary.hpp"
#include "pcrb_core/datasets/tum.hpp"
#include "pcrb_core/error.hpp"

namespace {

template <typename Parser>
void tryToParse(Parser parse, std::string_view text) {
  try {
    parse(text, "fuzz.txt");
  } catch (const pcrb::Error&) {
  }
}

void requireFinite(const pcrb::Trajectory& trajectory) {
  for (const auto stamp : {trajectory.firstStamp(), trajectory.lastStamp(),
                           trajectory.firstStamp() / 2 + trajectory.lastStamp() / 2}) {
    const auto answer = trajectory.interpolate(stamp, 100 * pcrb::kSecond);
    if (!answer.T_world_body.matrix().allFinite()) __builtin_trap();
  }
}

}  // namespace

/// The first byte chooses the reader.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto with = [](auto parse) {
    return [parse](std::string_view t, const std::string& name) { requireFinite(parse(t, name)); };
  };
  switch (data[0] % 7) {
    case 0:
      tryToParse(pcrb::parseLeicaPoses, text);
      break;
    case 1:
      tryToParse(pcrb::parsePlanetaryPose, text);
      break;
    case 2:
      tryToParse(with(pcrb::parseTumTrajectory), text);
      break;
    case 3:
      tryToParse(with(pcrb::parseKaistTrajectory), text);
      break;
    case 4:
      tryToParse(pcrb::parseTumImageList, text);
      break;
    case 5:
      tryToParse(pcrb::parseKaistStamps, text);
      break;
    default:
      tryToParse(pcrb::parsePlanetaryScan, text);
      break;
  }
  return 0;
}
