#include "bridge/node_processes.hpp"

#include <ros/network.h>
#include <unistd.h>

#include <array>

#include "node_place.hpp"

namespace pcrb {

namespace {

constexpr double kPatience = 2.0;  // s for a node to say which process it is

bool isHere(const std::string& host) {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return host == "localhost" || host.rfind("127.", 0) == 0 || host == ros::network::getHost() ||
         host == name.data();
}

}  // namespace

bool NodeProcesses::isAlive(const std::string& node, double limit) {
  const auto place = placeOf(node);
  return place && askForProcess(*place, limit).has_value();
}

std::optional<pid_t> NodeProcesses::processOf(const std::string& node) {
  const auto known = pids_.find(node);
  if (known != pids_.end() && (!known->second || usageOf(*known->second))) return known->second;
  const auto place = placeOf(node);
  const auto pid =
      place && isHere(place->host) ? askForProcess(*place, kPatience) : std::optional<pid_t>();
  return pids_[node] = pid;
}

std::optional<ProcessUsage> NodeProcesses::usage(const std::set<std::string>& nodes) {
  std::set<pid_t> processes;
  for (const auto& node : nodes) {
    if (const auto pid = processOf(node)) processes.insert(*pid);
  }
  ProcessUsage total;
  bool is_known = false;
  for (const pid_t pid : processes) {
    const auto used = usageOf(pid);
    if (!used) continue;
    is_known = true;
    const auto [before, is_new] = cpu_times_.emplace(pid, used->cpu_time);
    total.cpu_time += used->cpu_time - before->second;
    before->second = used->cpu_time;
    total.peak_memory += used->peak_memory;
  }
  if (!is_known) return std::nullopt;
  return total;
}

}  // namespace pcrb
