#pragma once

#include <string>

namespace pcrb_tools {

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
