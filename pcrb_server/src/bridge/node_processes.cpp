#include "bridge/node_processes.hpp"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>

#include <array>
#include <chrono>

namespace pcrb {

namespace {

constexpr double kPatience = 2.0;  // s for a node to say which process it is

struct Place {
  std::string host;
  std::uint32_t port = 0;
};

std::optional<Place> placeOf(const std::string& node) {
  XmlRpc::XmlRpcValue arguments, response, uri;
  arguments[0] = ros::this_node::getName();
  arguments[1] = node;
  if (!ros::master::execute("lookupNode", arguments, response, uri, false)) return std::nullopt;
  Place place;
  if (!ros::network::splitURI(std::string(uri), place.host, place.port)) return std::nullopt;
  return place;
}

bool isHere(const std::string& host) {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return host == "localhost" || host.rfind("127.", 0) == 0 || host == ros::network::getHost() ||
         host == name.data();
}

/// Asks a node for its process, for no longer than `limit` s.
std::optional<pid_t> askForProcess(const Place& place, double limit) {
  XmlRpc::XmlRpcClient client(place.host.c_str(), static_cast<int>(place.port), "/");
  XmlRpc::XmlRpcValue arguments, result;
  arguments[0] = ros::this_node::getName();
  if (!client.executeNonBlock("getPid", arguments)) return std::nullopt;
  XmlRpc::XmlRpcDispatch dispatch;
  dispatch.addSource(&client,
                     XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit);
  bool is_done = false;
  while (!is_done && std::chrono::steady_clock::now() < end) {
    dispatch.work(0.01);
    is_done = client.executeCheckDone(result);
  }
  dispatch.clear();
  // The node answers [1, text, pid].
  const bool is_answer = is_done && !client.isFault() &&
                         result.getType() == XmlRpc::XmlRpcValue::TypeArray && result.size() == 3 &&
                         result[2].getType() == XmlRpc::XmlRpcValue::TypeInt;
  if (!is_answer) return std::nullopt;
  return static_cast<pid_t>(int(result[2]));
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
