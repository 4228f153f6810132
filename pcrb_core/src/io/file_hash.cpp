#include "pcrb_core/io/file_hash.hpp"

#include <sodium.h>

#include <array>
#include <fstream>
#include <vector>

#include "pcrb_core/error.hpp"

namespace pcrb {

std::string fileHash(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InvalidFile(path, "cannot be opened");
  crypto_generichash_state state;
  std::array<unsigned char, crypto_generichash_BYTES> hash;
  crypto_generichash_init(&state, nullptr, 0, hash.size());
  std::vector<char> block(1 << 20);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    crypto_generichash_update(&state, reinterpret_cast<const unsigned char*>(block.data()),
                              static_cast<unsigned long long>(file.gcount()));
  }
  if (file.bad()) throw InvalidFile(path, "cannot be read to its end");
  crypto_generichash_final(&state, hash.data(), hash.size());
  std::array<char, 2 * crypto_generichash_BYTES + 1> text;
  sodium_bin2hex(text.data(), text.size(), hash.data(), hash.size());
  return text.data();
}

}  // namespace pcrb
