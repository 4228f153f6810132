#pragma once

#include <string>

namespace pcrb {

/// The right to write into a run folder, held by at most one object on the machine.
///
/// A lock of the kernel on the file `results.lock`, which stays behind: a killed writer leaves no
/// stale lock. The file's text says who holds it, for the message of whom it refuses.
class WriterLock {
 public:
  /// @throws StoreError  if another writer holds the lock, or the file cannot be made.
  explicit WriterLock(const std::string& run_folder);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace pcrb
