#include "pcrb_core/random.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "pcrb_core/error.hpp"

namespace pcrb {

std::uint64_t Random::below(std::uint64_t bound) {
  if (bound == 0) throw InvalidParameter("random: found bound 0, expected at least 1");
  // The lowest 2^64 mod bound values would make small results more frequent.
  const std::uint64_t excess = (0 - bound) % bound;
  std::uint64_t value = bits();
  while (value < excess) value = bits();
  return value % bound;
}

double Random::uniform(double min, double max) {
  const double width = max - min;
  if (!std::isfinite(width) || width < 0.0) {
    throw InvalidParameter("random: found the range " + std::to_string(min) + " to " +
                           std::to_string(max) + ", expected finite bounds in ascending order");
  }
  return std::min(max, min + width * uniform());
}

Eigen::Vector3d Random::direction() {
  // Archimedes: the height of a uniform point on the sphere is uniform.
  const double z = 2.0 * uniform() - 1.0;
  const double azimuth = 2.0 * M_PI * uniform();
  const double radius = std::sqrt((1.0 - z) * (1.0 + z));
  return Eigen::Vector3d(radius * std::cos(azimuth), radius * std::sin(azimuth), z).normalized();
}

Eigen::Quaterniond Random::rotation() {
  const double u = uniform();
  const double a = 2.0 * M_PI * uniform();
  const double b = 2.0 * M_PI * uniform();
  return Eigen::Quaterniond(std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                            std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b))
      .normalized();
}

}  // namespace pcrb
