#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace pcrb {

/// What a process has used so far.
struct ProcessUsage {
  double cpu_time = 0.0;          ///< s, user and system, of all its threads
  std::uint64_t peak_memory = 0;  ///< bytes, greatest resident set
};

/// @return  nothing if there is no such process, or it cannot be looked at.
std::optional<ProcessUsage> usageOf(pid_t pid);

}  // namespace pcrb
