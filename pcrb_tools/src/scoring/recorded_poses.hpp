#pragma once

#include <string>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/run/offline_run.hpp"

namespace pcrb_tools {

/// A pose that somebody wrote down, and what it is of.
struct RecordedPose {
  std::string label;      ///< of a text: its first word, a problem's id or a timestamp
  pcrb::Stamp stamp = 0;  ///< of a message: that of its header
  pcrb::OfflineReply reply;
  std::string place;  ///< file:line or bag, for messages
};

/// Reads a text of poses, a row each: `id r11 r12 r13 tx r21 … tz`, the first three rows of a 4 × 4
/// matrix, or `timestamp tx ty tz qx qy qz qw` (TUM's format, with an id for the timestamp too);
/// `#` comments.
///
/// A pose that is no pose (`nan`, a matrix that is no rotation) is kept with its defect.
/// @throws pcrb::InvalidFile  with line, for a row of another form.
std::vector<RecordedPose> readPoseTable(const std::string& path);

/// Reads the poses of a topic of a bag, of one of kPoseTypes.
///
/// @param frame  the map's; a leading slash does not count.
/// @throws pcrb::InvalidFile  if the bag has no such topic, or the topic another type, or a pose is
///                            in another frame.
std::vector<RecordedPose> readBagPoses(const std::string& path, const std::string& topic,
                                       const std::string& frame);

/// readBagPoses() for a bag, by its name's end, else readPoseTable().
std::vector<RecordedPose> readPoses(const std::string& path, const std::string& topic,
                                    const std::string& frame);

}  // namespace pcrb_tools
