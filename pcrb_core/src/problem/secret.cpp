#include "pcrb_core/problem/secret.hpp"

#include <sodium.h>

#include <cmath>
#include <cstring>

#include "pcrb_core/error.hpp"

namespace pcrb {

namespace {

std::string hex(const unsigned char* bytes, std::size_t count) {
  std::string text(2 * count + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes, count);
  text.pop_back();
  return text;
}

}  // namespace

static_assert(crypto_shorthash_KEYBYTES == 16, "a run's secret is the key of the keyed hash");

Secret Secret::draw() {
  if (sodium_init() < 0) throw Error("libsodium cannot be initialised");
  Secret secret;
  randombytes_buf(secret.key_.data(), secret.key_.size());
  return secret;
}

Secret Secret::fromHex(const std::string& text) {
  Secret secret;
  std::size_t size = 0;
  const int status = sodium_hex2bin(secret.key_.data(), secret.key_.size(), text.data(),
                                    text.size(), nullptr, &size, nullptr);
  if (status != 0 || size != secret.key_.size() || text.size() != 2 * size) {
    throw InvalidParameter("secret: found `" + text + "`, expected 32 hexadecimal digits");
  }
  return secret;
}

std::string Secret::toHex() const { return hex(key_.data(), key_.size()); }

std::uint64_t Secret::bits(const std::string& purpose, const std::string& subject) const {
  const std::string message = purpose + '\n' + subject;
  std::array<unsigned char, crypto_shorthash_BYTES> hash;
  crypto_shorthash(hash.data(), reinterpret_cast<const unsigned char*>(message.data()),
                   message.size(), key_.data());
  std::uint64_t value = 0;
  for (const unsigned char byte : hash) value = (value << 8) | byte;
  return value;
}

std::string Secret::publicId(const std::string& subject) const {
  std::string id;
  for (const char* purpose : {"id 0", "id 1"}) {
    const std::uint64_t value = bits(purpose, subject);
    std::array<unsigned char, 8> bytes;
    std::memcpy(bytes.data(), &value, bytes.size());
    id += hex(bytes.data(), bytes.size());
  }
  return id;
}

double Secret::uniform(const std::string& purpose, const std::string& subject) const {
  return static_cast<double>(bits(purpose, subject) >> 11) * 0x1p-53;
}

Eigen::Quaterniond Secret::yaw(const std::string& subject) const {
  const double angle = 2.0 * M_PI * uniform("yaw", subject);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

Eigen::Quaterniond Secret::rotation(const std::string& subject) const {
  const double u = uniform("rotation 0", subject);
  const double a = 2.0 * M_PI * uniform("rotation 1", subject);
  const double b = 2.0 * M_PI * uniform("rotation 2", subject);
  return Eigen::Quaterniond(std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                            std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b));
}

}  // namespace pcrb
