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

/// Removes the temporary files that killed processes left of an AtomicFile.
///
/// @param name  of the file, or the start of the names of several; empty: of all in the folder.
void removeTemporaryFiles(const std::string& folder, const std::string& name = {});

/// The right to what a file stands for, held by at most one object on the machine.
///
/// A lock of the kernel on the file, which stays behind: who is killed leaves no stale lock. The
/// file's text says who holds it, for the message of whom it refuses.
class FileLock {
 public:
  /// Makes the file where it is missing, and takes the lock unless somebody has it.
  /// @throws InvalidFile  if the file cannot be opened or locked.
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  bool isHeld() const { return holder_.empty(); }

  /// Who has it if not this object, e.g. `process 17 on host`.
  const std::string& holder() const { return holder_; }

  /// Of the open file: a process that inherits it holds the lock, too.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
  std::string holder_;
};

}  // namespace pcrb
