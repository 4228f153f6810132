#pragma once

#include <string>

namespace pcrb {

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
