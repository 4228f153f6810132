#include "pcrb_tools/simulation/noise.hpp"

#include <cmath>

namespace pcrb_tools::simulation {

pcrb::Random makeStream(std::uint64_t seed, std::string_view name, std::uint64_t index) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
  const auto take = [&hash](std::uint64_t byte) { hash = (hash ^ byte) * 0x100000001b3ULL; };
  for (const char letter : name) take(static_cast<unsigned char>(letter));
  for (const std::uint64_t number : {seed, index}) {
    for (int shift = 0; shift < 64; shift += 8) take((number >> shift) & 0xff);
  }
  return pcrb::Random(hash);
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
