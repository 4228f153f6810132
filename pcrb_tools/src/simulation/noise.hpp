#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "pcrb_core/random.hpp"

namespace pcrb_tools::simulation {

/// Random numbers of one piece of work (a scan, a frame, a scene): they depend on the seed, the
/// piece's name and its index only, so that the order of work and the threads do not matter.
pcrb::Random makeStream(std::uint64_t seed, std::string_view name, std::uint64_t index = 0);

/// A sample of the standard normal distribution (Box and Muller).
double drawNormal(pcrb::Random& random);

// C++ leaves open which argument of a call is computed first: what draws more than once in an
// expression goes through these, or through variables, so that all compilers give the same bytes.

/// Uniform between two corners of a box.
Eigen::Vector3d drawBetween(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                            pcrb::Random& random);

/// Within the unit ball, the radius distributed as the root of a uniform number.
Eigen::Vector3d drawInBall(pcrb::Random& random);

}  // namespace pcrb_tools::simulation
