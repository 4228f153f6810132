#pragma once

#include <string>

namespace pcrb_tools {

/// Names what is not a bag of ROS 1, by its first bytes.
/// @throws InvalidFile
void requireRos1Bag(const std::string& path);

/// Makes sure that a bag was closed and is whole: its index begins where its header says and ends
/// with the file. Reads a few bytes only of what comes before.
///
/// @throws InvalidFile  if it is no bag of ROS 1, was not closed, or is cut; it says which.
void requireWholeBag(const std::string& path);

/// Makes sure that rosbag, which believes what it reads, can be given a bag: records lie where the
/// index says, in the file and in their chunks, and index and every chunk fit into the process's
/// MemoryBudget. Unpacks every packed chunk for that; of others it reads messages' headers only.
///
/// @throws InvalidFile  as requireWholeBag(), or saying at which byte what is damaged or too large.
void requireReadableBag(const std::string& path);

}  // namespace pcrb_tools
