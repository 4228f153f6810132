#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace pcrb {

/// The bytes of a file in memory.
class FileBytes {
 public:
  /// @throws InvalidFile  if the path is no regular file or cannot be read.
  explicit FileBytes(const std::string& path);

  const char* begin() const { return bytes_.get(); }
  const char* end() const { return bytes_.get() + size_; }
  std::size_t size() const { return size_; }
  std::string_view text() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;  // not a std::string, which would write zeros first
  std::size_t size_ = 0;
};

/// BLAKE2b-256 of a file's bytes as 64 hexadecimal digits (libsodium).
///
/// @throws InvalidFile  if the file cannot be read.
std::string fileHash(const std::string& path);

/// SHA-256 of a file's bytes as 64 hexadecimal digits (libsodium): what `sha256sum` prints.
///
/// @throws InvalidFile  if the file cannot be read.
std::string fileSha256(const std::string& path);

}  // namespace pcrb
