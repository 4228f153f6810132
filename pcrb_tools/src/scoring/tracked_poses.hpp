#pragma once

#include <string>
#include <vector>

#include "pcrb_core/datasets/trajectory.hpp"
#include "pcrb_server/playback/scene.hpp"
#include "scoring/scoring_tool.hpp"

namespace pcrb_tools {

/// The trajectory that a tracker wrote: a text in any pcrb::PoseFormat, or poses or tf of a bag.
/// Poses without timestamps are those of the scans in their order, or of the file that they name.
///
/// @param notes  what was concluded from the file is added
/// @throws pcrb::InvalidFile  for files that are not as they should be.
pcrb::Trajectory readTrackedPoses(const TrackingOptions& options, const pcrb::ScanList& list,
                                  std::vector<std::string>& notes);

/// The offset in seconds which, added to the stamps of the estimate, lets its motions between
/// scans fit the true ones best: the least mean square of the relative errors of translation.
///
/// @param truth  T_map_sensor of the scans
/// @param largest  s, > 0: offsets up to it are tried, both ways
/// @throws pcrb::InvalidParameter  if fewer than three motions can be compared, or all offsets fit
///                                 as well: a motion without change says nothing of time.
double estimateTimeOffset(const std::vector<pcrb::StampedPose>& truth,
                          const pcrb::Trajectory& estimate, const pcrb::Transform& T_body_sensor,
                          double largest);

/// The trajectory with something added to its stamps.
pcrb::Trajectory shifted(const pcrb::Trajectory& trajectory, double seconds);

}  // namespace pcrb_tools
