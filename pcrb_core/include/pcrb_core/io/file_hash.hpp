#pragma once

#include <string>

namespace pcrb {

/// BLAKE2b-256 of a file's bytes as 64 hexadecimal digits (libsodium).
///
/// @throws InvalidFile  if the file cannot be read.
std::string fileHash(const std::string& path);

/// SHA-256 of a file's bytes as 64 hexadecimal digits (libsodium): what `sha256sum` prints.
///
/// @throws InvalidFile  if the file cannot be read.
std::string fileSha256(const std::string& path);

}  // namespace pcrb
