#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_server/playback/scene.hpp"

namespace pcrb {

/// Which scan was handed out when, and in which frame: what score_poses needs to score a node's
/// trajectory. A text of rows `timestamp file`, as TUM's lists of images, below a comment with the
/// local origin.
struct ScanList {
  Eigen::Vector3d local_origin = Eigen::Vector3d::Zero();  ///< m: p_dataset = p_map + local_origin
  std::map<Stamp, std::string> scans;                      ///< file names
};

/// Appends a scene's row; for an empty text first the header.
void appendScan(std::string& text, const Scene& scene);

/// @throws InvalidFile  with line, what was found and what was expected.
ScanList readScanList(const std::string& path);

}  // namespace pcrb
