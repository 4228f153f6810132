#include "pcrb_core/io/file_bytes.hpp"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "io/large_pages.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/memory_budget.hpp"

namespace pcrb {
namespace {

/// A file open for reading.
class Descriptor {
 public:
  explicit Descriptor(const std::string& path)
      // A FIFO without a writer would block here.
      : path_(path), descriptor_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (descriptor_ < 0) fail("open");
  }
  ~Descriptor() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  /// Size in bytes of the regular file that this must be.
  std::size_t size() const {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) fail("read");
    if (!S_ISREG(status.st_mode)) {
      throw InvalidFile(path_, 0, S_ISDIR(status.st_mode) ? "a folder" : "a special file",
                        "a regular file");
    }
    return static_cast<std::size_t>(status.st_size);
  }

  /// Fills up to `size` bytes; returns how many there were.
  std::size_t read(char* bytes, std::size_t size) const {
    std::size_t done = 0;
    while (done < size) {
      const ssize_t got = ::read(descriptor_, bytes + done, size - done);
      if (got < 0 && errno != EINTR) fail("read");
      if (got == 0)
        break;  // shorter than it was: the reader of the format will say what is missing
      if (got > 0) done += static_cast<std::size_t>(got);
    }
    return done;
  }

 private:
  [[noreturn]] void fail(const char* action) const {
    throw InvalidFile(path_, std::string("cannot ") + action + ": " + std::strerror(errno));
  }

  const std::string& path_;
  int descriptor_;
};

}  // namespace

namespace {

/// A file on a disk may claim any size and take none.
void requireWithinBudget(const std::string& path, std::size_t size) {
  const std::size_t limit = MemoryBudget::ofProcess().limit();
  if (size <= limit) return;
  const auto [found, expected] = describeExcess("a file", size, limit);
  throw InvalidFile(path, 0, found, expected);
}

}  // namespace

FileBytes::FileBytes(const std::string& path) {
  const Descriptor file(path);
  const std::size_t size = file.size();
  requireWithinBudget(path, size);
  bytes_.reset(new char[size]);
  preferLargePages(bytes_.get(), size);
  size_ = file.read(bytes_.get(), size);
}

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

std::optional<std::string> startOfFile(const std::string& path, std::size_t size) {
  std::string start(size, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(size));
  if (file.bad() || !file.is_open()) return std::nullopt;
  start.resize(static_cast<std::size_t>(file.gcount()));
  return start;
}

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

std::string fingerprintOf(std::string_view text) {
  Fnv1a hash;
  hash.add(text);
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) {
    digits += "0123456789abcdef"[hash.value() >> shift & 0xf];
  }
  return digits;
}

}  // namespace pcrb
