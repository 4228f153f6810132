#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// The 128 random bits of a run, from which all that a client must not foresee is derived: problem
/// ids, the order of perturbations, secret rotations.
///
/// Each derivation is a keyed hash (SipHash-2-4 of libsodium), so that what a client sees of one
/// tells it nothing of another. The same bits always give the same values.
class Secret {
 public:
  /// New bits from the operating system.
  static Secret draw();

  /// @throws InvalidParameter  unless the text is 32 hexadecimal digits.
  static Secret fromHex(const std::string& text);

  std::string toHex() const;

  /// 64 bits for one purpose and subject, e.g. ("order", "plain local 4215528470000").
  std::uint64_t bits(const std::string& purpose, const std::string& subject) const;

  /// A number in [0, 1).
  double uniform(const std::string& purpose, const std::string& subject) const;

  /// Neutral id of a problem: 32 hexadecimal digits.
  std::string publicId(const std::string& subject) const;

  /// Rotation about z by a uniform angle.
  Eigen::Quaterniond yaw(const std::string& subject) const;

  /// Uniformly random rotation. Source: Shoemake, Uniform random rotations, Graphics Gems III,
  /// 1992.
  Eigen::Quaterniond rotation(const std::string& subject) const;

 private:
  std::array<unsigned char, 16> key_{};
};

}  // namespace pcrb
