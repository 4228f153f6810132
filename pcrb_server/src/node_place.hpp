#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

namespace pcrb {

/// Where a node's own port is.
struct NodePlace {
  std::string host;
  std::uint32_t port = 0;
};

/// Where the master knows a node to be, dead or alive: one that was killed stays entered. Needs no
/// ros::start().
std::optional<NodePlace> placeOf(const std::string& node);

/// Asks the node at a place for its process; nothing if none answers within `limit` s.
std::optional<pid_t> askForProcess(const NodePlace& place, double limit);

}  // namespace pcrb
