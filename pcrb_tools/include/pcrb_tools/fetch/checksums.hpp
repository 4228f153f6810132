#pragma once

#include <map>
#include <string>

namespace pcrb_tools {

/// The SHA-256 of files that have been fetched, in a text file that `sha256sum --check` reads too.
class Checksums {
 public:
  /// @param path  of the list; it need not exist yet.
  /// @throws pcrb::InvalidFile  with file and line for malformed rows.
  explicit Checksums(std::string path);

  /// Records a file's checksum when it is seen first, and verifies it later.
  ///
  /// @param name      of the file in the list.
  /// @param expected  from the list of sources; empty where it is not known.
  /// @throws pcrb::InvalidFile  if the file's checksum is another one.
  void check(const std::string& name, const std::string& path, const std::string& expected);

  /// A recorded checksum, or an empty text.
  std::string find(const std::string& name) const;

 private:
  std::string path_;
  std::map<std::string, std::string> sha256_of_;
};

}  // namespace pcrb_tools
