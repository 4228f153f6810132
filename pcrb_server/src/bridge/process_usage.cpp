#include "bridge/process_usage.hpp"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace pcrb {

namespace {

/// s of user and system time; a process's name may hold blanks and parentheses.
std::optional<double> cpuTime(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  std::string skipped;
  for (int i = 3; i < 14; ++i) fields >> skipped;  // proc(5): utime is field 14
  double user = 0.0;
  double system = 0.0;
  if (!(fields >> user >> system)) return std::nullopt;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

std::optional<std::uint64_t> peakMemory(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/status");
  for (std::string word; file >> word;) {
    std::uint64_t kibibytes = 0;
    if (word == "VmHWM:" && file >> kibibytes) return kibibytes * 1024;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ProcessUsage> usageOf(pid_t pid) {
  const auto cpu = cpuTime(pid);
  const auto memory = peakMemory(pid);
  if (!cpu || !memory) return std::nullopt;
  return ProcessUsage{*cpu, *memory};
}

}  // namespace pcrb
