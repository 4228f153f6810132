#pragma once

#include <cstddef>
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
  /// @param expected  from the list of sources, which counts before what is recorded; empty = not
  ///                  known.
  /// @throws pcrb::InvalidFile  if the file's checksum is another one; says which line to delete if
  ///                            the recorded one is of a damaged file.
  void check(const std::string& name, const std::string& path, const std::string& expected);

  /// A recorded checksum, or an empty text.
  std::string find(const std::string& name) const;

 private:
  struct Recorded {
    std::string sha256;
    std::size_t line;  ///< of the list, from 1
  };

  void write();

  std::string path_;
  std::map<std::string, Recorded> recorded_;  ///< by name
};

}  // namespace pcrb_tools
