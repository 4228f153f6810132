#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pcrb {

/// A file that appears complete or not at all.
///
/// Writes go to a hidden temporary name in the same folder; commit() renames it. Without commit()
/// the destructor removes it and leaves a file that was there before untouched.
class AtomicFile {
 public:
  /// @param path  a regular file, new or to be replaced; a link to one is followed.
  /// @throws InvalidFile  if the path is something else or its folder is not writable.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends; buffered.
  /// @throws InvalidFile  if the system cannot write, e.g. on a full disk.
  void write(std::string_view text);

  /// Writes what is buffered, waits until the disk has it (fsync), then renames. Call once, last.
  /// @throws InvalidFile  if any of that fails; the temporary file is removed.
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(const char* action) const;

  std::string path_;
  std::string temporary_path_;
  std::string buffer_;
  int descriptor_ = -1;
};

/// Writes a whole file through AtomicFile.
/// @throws InvalidFile  if the file cannot be written completely.
void writeFileAtomically(const std::string& path, std::string_view text);

}  // namespace pcrb
