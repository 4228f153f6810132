#pragma once

#include <sys/types.h>

#include <set>
#include <vector>

namespace pcrb {

/// Processes on this machine that descend from one, those that have ended but were not waited for
/// included.
///
/// @param root  is not among them.
/// @param but   neither are these, nor what descends from them.
std::vector<pid_t> processesBelow(pid_t root, const std::set<pid_t>& but = {});

}  // namespace pcrb
