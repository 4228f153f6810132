#pragma once

#include <string>
#include <vector>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {

/// The user's wish to stop, as an exception: temporary files are cleared on its way out.
class Interrupted : public pcrb::Error {
 public:
  Interrupted()
      : Error("interrupted; what is complete is kept and the next run goes on from there") {}
};

/// While it lives, SIGINT and SIGTERM only set a flag; a second signal ends the process at once.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// @throws Interrupted  once a signal has come to the Interruption that there is.
  static void check();
};

/// Runs a program with this process' standard streams and waits for it.
///
/// @param command  its path and arguments; no shell is involved.
/// @return         its exit status, or 128 + the signal that ended it.
/// @throws pcrb::InvalidFile  if it cannot be started.
int runChild(const std::vector<std::string>& command);

/// A folder for temporary files, empty at first and gone in the end.
class TemporaryFolder {
 public:
  /// A new one below TMPDIR or /tmp.
  /// @param name  what its name begins with.
  /// @throws pcrb::InvalidFile  if it cannot be made.
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace pcrb_tools
