#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace pcrb {

/// Random numbers that are the same for the same seed on every platform: own sampling from the raw
/// bits of `std::mt19937_64`, whose sequence the standard fixes (that of its distributions it does
/// not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// 64 uniform bits.
  std::uint64_t bits() { return engine_(); }

  /// Uniform on 0 … bound − 1, without bias (rejection).
  /// @throws InvalidParameter  if bound is 0.
  std::uint64_t below(std::uint64_t bound);

  /// Uniform on [0, 1): a multiple of 2⁻⁵³.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform on [min, max]; rounding may give max itself.
  /// @throws InvalidParameter  unless both are finite and min <= max.
  double uniform(double min, double max);

  /// Uniform on the unit sphere.
  Eigen::Vector3d direction();

  /// Uniform over all rotations; unit.
  /// Source: Shoemake, Uniform random rotations, Graphics Gems III, 1992.
  Eigen::Quaterniond rotation();

  /// Puts the elements into a uniformly random order (Fisher and Yates).
  template <typename T>
  void shuffle(std::vector<T>& elements) {
    for (std::size_t i = elements.size(); i > 1; --i) {
      std::swap(elements[i - 1], elements[static_cast<std::size_t>(below(i))]);
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace pcrb
