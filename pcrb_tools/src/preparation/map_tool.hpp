#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pcrb_tools {

/// What `build_map` is asked for.
struct MapOptions {
  std::string folder;          ///< `<root>/<data set>/<sequence>`
  std::string output;          ///< the map, a PCD file
  std::optional<double> leaf;  ///< edge of a voxel, m; empty = the data set's
  std::vector<std::string> excluded;
  int threads = 1;
  bool force = false;  ///< replace an output that somebody else made
};

/// Merges the clouds of a sequence, which are in the world frame, into the centroids of voxels.
///
/// Memory is bounded by the map and by one cloud per thread. The map's bytes do not depend on the
/// threads. An output that is complete and unchanged is kept.
/// @throws pcrb::Error  if a cloud, the data set's parameters or the output is not as it should be.
void runMapTool(const MapOptions& options);

}  // namespace pcrb_tools
