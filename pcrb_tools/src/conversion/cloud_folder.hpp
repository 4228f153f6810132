#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/point_cloud.hpp"

namespace pcrb_tools {

/// A short text that differs when the description differs: FNV-1a, 64 bits, hexadecimal.
std::string fingerprintOf(const std::string& description);

/// Folder `<root>/<data set>/<sequence>` that a conversion writes.
///
/// The hidden file `.conversion` in it records for each cloud what it was made from, so a rerun
/// keeps what is complete and unchanged. One process at a time.
class CloudFolder {
 public:
  /// Makes the folder, takes its lock, clears temporary files that a killed run has left.
  /// @throws InvalidParameter  if a name is no plain folder name.
  /// @throws InvalidFile       if it cannot be written, or another conversion is writing it.
  CloudFolder(const std::string& root, const std::string& data_set, const std::string& sequence);
  ~CloudFolder();
  CloudFolder(const CloudFolder&) = delete;
  CloudFolder& operator=(const CloudFolder&) = delete;

  const std::string& path() const { return path_; }

  /// What an earlier run counted for a cloud, if the file is the one that it wrote from the same.
  ///
  /// @param fingerprint  of everything that the cloud depends on.
  std::optional<pcrb::PointCounts> kept(const std::string& name,
                                        const std::string& fingerprint) const;

  /// @throws InvalidFile  if a file of this name is there that is somebody else's: not recorded by
  ///                      a conversion, or changed since.
  void requireReplaceable(const std::string& name) const;

  /// Writes a cloud, complete or not at all, and records it. Can be called from several threads.
  /// @throws InvalidFile  if it cannot be written completely.
  void write(const std::string& name, const std::string& fingerprint,
             const pcrb::DatasetCloud& cloud, const pcrb::PointCounts& counts);

  /// Removes the clouds that earlier runs recorded, if they are unchanged, other than those named.
  /// @return  the names of the removed ones.
  std::vector<std::string> removeStale(const std::set<std::string>& names);

  /// Clouds in the folder that are not among the names, in natural order; `box_map.pcd` is not
  /// meant.
  std::vector<std::string> othersThan(const std::set<std::string>& names) const;

 private:
  struct Record {
    std::string fingerprint;
    std::string file_identity;  ///< size and time of writing; empty: it was about to be written
    pcrb::PointCounts counts;
  };

  void openRecords();
  void readRecords();
  void clearTemporaryFiles() const;
  std::string fileOf(const std::string& name) const;
  std::optional<Record> find(const std::string& name) const;
  void record(const std::string& name, const Record& record);

  std::string path_;
  std::map<std::string, Record> records_;
  mutable std::mutex mutex_;
  int descriptor_ = -1;
};

}  // namespace pcrb_tools
