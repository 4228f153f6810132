#include "pcrb_core/io/file_hash.hpp"

#include <sodium.h>

#include <array>
#include <fstream>
#include <vector>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kHashBytes = 32;
static_assert(crypto_generichash_BYTES == kHashBytes && crypto_hash_sha256_BYTES == kHashBytes);

using Hash = std::array<unsigned char, kHashBytes>;

/// Hands a file's bytes to `update`, block by block.
template <typename Update>
void readBlocks(const std::string& path, const Update& update) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InvalidFile(path, "cannot be opened");
  std::vector<char> block(1 << 20);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    update(reinterpret_cast<const unsigned char*>(block.data()),
           static_cast<unsigned long long>(file.gcount()));
  }
  if (file.bad()) throw InvalidFile(path, "cannot be read to its end");
}

std::string toHex(const Hash& hash) {
  std::array<char, 2 * kHashBytes + 1> text;
  sodium_bin2hex(text.data(), text.size(), hash.data(), hash.size());
  return text.data();
}

}  // namespace

std::string fileHash(const std::string& path) {
  crypto_generichash_state state;
  crypto_generichash_init(&state, nullptr, 0, kHashBytes);
  readBlocks(path, [&](const unsigned char* bytes, unsigned long long n) {
    crypto_generichash_update(&state, bytes, n);
  });
  Hash hash;
  crypto_generichash_final(&state, hash.data(), hash.size());
  return toHex(hash);
}

std::string fileSha256(const std::string& path) {
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  readBlocks(path, [&](const unsigned char* bytes, unsigned long long n) {
    crypto_hash_sha256_update(&state, bytes, n);
  });
  Hash hash;
  crypto_hash_sha256_final(&state, hash.data());
  return toHex(hash);
}

}  // namespace pcrb
