#pragma once

#include <sys/types.h>

#include <set>

namespace pcrb_tools {

/// From now on this process is the parent of what its descendants leave behind when they end.
void adoptOrphans();

/// Ends all processes below this one: SIGTERM, and SIGKILL to those that do not heed it for 5 s.
/// Returns when none is left.
/// @param but  these and what is below them go on.
void endOrphans(const std::set<pid_t>& but);

}  // namespace pcrb_tools
