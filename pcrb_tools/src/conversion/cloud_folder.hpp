#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pcrb_core/datasets/sensor_scan.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/point_cloud.hpp"

namespace pcrb_tools {

/// Folder `<root>/<data set>/<sequence>` that a conversion writes.
///
/// The hidden file `.conversion` in it records for each cloud what it was made from, with the
/// counts of its points, so a rerun keeps what is complete and unchanged. One process at a time;
/// clouds can be written from several threads.
class CloudFolder {
 public:
  /// @throws InvalidParameter  if a name is no plain folder name.
  /// @throws InvalidFile       if it cannot be written, or another conversion is writing it.
  CloudFolder(const std::string& root, const std::string& data_set, const std::string& sequence);

  const std::string& path() const { return files_.path(); }

  /// What an earlier run counted for a cloud, if the file is the one that it wrote from the same.
  ///
  /// @param fingerprint  of everything that the cloud depends on.
  std::optional<pcrb::PointCounts> kept(const std::string& name,
                                        const std::string& fingerprint) const;

  /// @throws InvalidFile  if a file of this name is there that is somebody else's: not recorded by
  ///                      a conversion, or changed since.
  void requireReplaceable(const std::string& name) const { files_.requireReplaceable(name); }

  /// Writes a cloud, complete or not at all: it is not there yet.
  ///
  /// @return  waits until the disk has it, puts it into its place and records it, on any thread,
  ///          while this folder is there. Nothing is left of a cloud whose function was not called.
  /// @throws InvalidFile, as its function does, if it cannot be written completely.
  std::function<void()> write(const std::string& name, const std::string& fingerprint,
                              const pcrb::DatasetCloud& cloud, const pcrb::PointCounts& counts);

  /// Removes the clouds that earlier runs recorded, if they are unchanged, other than those named.
  /// @return  the names of the removed ones.
  std::vector<std::string> removeStale(const std::set<std::string>& names);

  /// Clouds in the folder that are not among the names, in natural order; `box_map.pcd` is not
  /// meant.
  std::vector<std::string> othersThan(const std::set<std::string>& names) const;

 private:
  pcrb::DerivedFolder files_;
};

}  // namespace pcrb_tools
