#pragma once

#include <cstddef>
#include <string>

namespace pcrb_tools {

/// A hidden folder for files from an archive that are needed in another order than they come in.
/// Names in it are numbers, never the archive's. It goes with the object; what a killed run left
/// goes with the next run.
class SpoolFolder {
 public:
  /// @param folder  of the clouds; nothing is made before the first write
  explicit SpoolFolder(const std::string& folder);
  ~SpoolFolder();
  SpoolFolder(const SpoolFolder&) = delete;
  SpoolFolder& operator=(const SpoolFolder&) = delete;

  /// @throws InvalidFile  if the disk is full or not writable.
  void write(std::size_t number, const std::string& bytes) const;

  std::string path(std::size_t number) const;

 private:
  std::string folder_;
};

}  // namespace pcrb_tools
