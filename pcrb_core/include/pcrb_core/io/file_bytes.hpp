#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace pcrb {

/// The bytes of a file in memory.
class FileBytes {
 public:
  /// @throws InvalidFile  if the path is no regular file, cannot be read, or is larger than the
  ///                      process's MemoryBudget.
  explicit FileBytes(const std::string& path);

  const char* begin() const { return bytes_.get(); }
  const char* end() const { return bytes_.get() + size_; }
  std::size_t size() const { return size_; }
  std::string_view text() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;  // not a std::string, which would write zeros first
  std::size_t size_ = 0;
};

/// The first bytes of a file, at most so many; nothing if it cannot be read.
std::optional<std::string> startOfFile(const std::string& path, std::size_t size);

/// BLAKE2b-256 of a file's bytes as 64 hexadecimal digits (libsodium).
///
/// @throws InvalidFile  if the file cannot be read.
std::string fileHash(const std::string& path);

/// SHA-256 of a file's bytes as 64 hexadecimal digits (libsodium): what `sha256sum` prints.
///
/// @throws InvalidFile  if the file cannot be read.
std::string fileSha256(const std::string& path);

/// A quick hash of what is added, in its order (FNV-1a, 64 bits); keeps nothing secret.
class Fnv1a {
 public:
  /// Adds a byte, or 64 bits at once, which gives another hash than byte by byte.
  void add(std::uint64_t bits) { hash_ = (hash_ ^ bits) * 0x100000001b3ULL; }
  void add(std::string_view text) {
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

/// A text of 16 hexadecimal digits that differs when the text differs: its Fnv1a.
std::string fingerprintOf(std::string_view text);

}  // namespace pcrb
