#pragma once

#include <string>
#include <vector>

namespace pcrb_tools {

/// Runs a program with this process' standard streams and waits for it.
///
/// @param command  its path and arguments; no shell is involved.
/// @return         its exit status, or 128 + the signal that ended it.
/// @throws pcrb::InvalidFile  if it cannot be started.
int runChild(const std::vector<std::string>& command);

}  // namespace pcrb_tools
