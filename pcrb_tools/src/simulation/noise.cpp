#include "simulation/noise.hpp"

#include <cmath>

#include "pcrb_core/io/file_bytes.hpp"

namespace pcrb_tools::simulation {

pcrb::Random makeStream(std::uint64_t seed, std::string_view name, std::uint64_t index) {
  pcrb::Fnv1a hash;
  hash.add(name);
  for (const std::uint64_t number : {seed, index}) {
    for (int shift = 0; shift < 64; shift += 8) hash.add((number >> shift) & 0xff);
  }
  return pcrb::Random(hash.value());
}

double drawNormal(pcrb::Random& random) {
  constexpr double kTwoPi = 6.283185307179586;
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return radius * std::cos(kTwoPi * random.uniform());
}

Eigen::Vector3d drawBetween(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                            pcrb::Random& random) {
  Eigen::Vector3d drawn;
  for (int axis = 0; axis < 3; ++axis) drawn[axis] = random.uniform(low[axis], high[axis]);
  return drawn;
}

Eigen::Vector3d drawInBall(pcrb::Random& random) {
  const double radius = std::sqrt(random.uniform());
  return radius * random.direction();
}

}  // namespace pcrb_tools::simulation
