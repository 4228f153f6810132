#pragma once

#include <cstdint>
#include <string_view>

#include "pcrb_core/random.hpp"

namespace pcrb_tools::simulation {

/// Random numbers of one piece of work (a scan, a frame, a scene): they depend on the seed, the
/// piece's name and its index only, so that the order of work and the threads do not matter.
pcrb::Random makeStream(std::uint64_t seed, std::string_view name, std::uint64_t index = 0);

/// A sample of the standard normal distribution (Box and Muller).
double drawNormal(pcrb::Random& random);

}  // namespace pcrb_tools::simulation
