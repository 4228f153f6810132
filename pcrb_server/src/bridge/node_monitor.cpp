#include "bridge/node_monitor.hpp"

#include <ros/network.h>
#include <std_srvs/Trigger.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "pcrb_core/io/text.hpp"
#include "ros/node_calls.hpp"
#include "ros/notices.hpp"

namespace pcrb {

namespace {

constexpr double kSupervisorLimit = 60.0;  // s for the supervisor to come up
constexpr double kQuestionLimit = 0.1;     // s to find out whether there is one
constexpr double kLifeLimit = 2.0;  // s for a node that did not answer a problem to show life
constexpr double kPidLimit = 5.0;   // s for a node to say which process it is

bool isHere(const std::string& host) {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return host == "localhost" || startsWith(host, "127.") || host == ros::network::getHost() ||
         host == name.data();
}

}  // namespace

bool NodeProcesses::isAlive(const std::string& node, double limit) {
  const auto address = addressOf(node);
  return address && queryPid(*address, limit).has_value();
}

std::optional<pid_t> NodeProcesses::processOf(const std::string& node) {
  const auto known = pids_.find(node);
  if (known != pids_.end() && (!known->second || usageOf(*known->second))) return known->second;
  const auto address = addressOf(node);
  const auto pid =
      address && isHere(address->host) ? queryPid(*address, kPidLimit) : std::optional<pid_t>();
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

NodeMonitor::NodeMonitor(ros::NodeHandle& node, const BridgeParameters& parameters,
                         const RobotInputs& inputs)
    : parameters_(parameters), inputs_(inputs), node_(node) {}

void NodeMonitor::beginProblem(bool is_new_target) {
  using Restart = BridgeParameters::Restart;
  needs_restart_ |= parameters_.restart == Restart::kProblem ||
                    (parameters_.restart == Restart::kTarget && is_new_target);
}

bool NodeMonitor::restart() {
  needs_restart_ = false;
  before_ = inputs_.nodes();
  std_srvs::Trigger service;
  auto client = node_.serviceClient<std_srvs::Trigger>(parameters_.restart_service);
  // The supervisor may just be starting where it is needed for sure.
  const bool is_supervised = parameters_.restart != BridgeParameters::Restart::kNever;
  const bool is_answered =
      client.waitForExistence(ros::Duration(is_supervised ? kSupervisorLimit : kQuestionLimit)) &&
      client.call(service);
  if (is_answered && service.response.success != 0) return true;
  tellPeople("the node under test cannot be restarted: " +
             (is_answered
                  ? std::string(service.response.message)
                  : "no node answers on " + client.getService() + " (only under node_supervisor)"));
  before_.clear();
  return false;
}

bool NodeMonitor::isThere() const {
  if (!inputs_.isScanTaken()) return false;
  const auto nodes = inputs_.nodes();
  return std::any_of(nodes.begin(), nodes.end(), [this](const auto& node) {
    const auto before = before_.find(node.first);
    return before == before_.end() || node.second > before->second;
  });
}

void NodeMonitor::beginWatch() { at_start_ = inputs_.nodes(); }

void NodeMonitor::extendWatch() {
  auto nodes = inputs_.nodes();
  nodes.merge(at_start_);
  at_start_ = std::move(nodes);
}

void NodeMonitor::beginPlay() { processes_.usage(inputs_.allNodes()); }

bool NodeMonitor::hasLeft() const {
  const auto departures = inputs_.departures();
  return std::any_of(departures.begin(), departures.end(), [this](const auto& node) {
    const auto come = at_start_.find(node.first);
    return come != at_start_.end() && node.second >= come->second;
  });
}

int NodeMonitor::restartCount() const {
  const auto arrivals = inputs_.nodes();
  int sum = 0;
  for (const auto& [node, departures] : inputs_.departures()) {
    const auto come = arrivals.find(node);
    sum += std::max(departures, come == arrivals.end() ? 0 : come->second - 1);
  }
  return sum;
}

bool NodeMonitor::isHanging() const {
  const auto nodes = inputs_.nodes();
  return std::any_of(nodes.begin(), nodes.end(), [](const auto& node) {
    return !NodeProcesses::isAlive(node.first, kLifeLimit);
  });
}

void NodeMonitor::endProblem(bool is_answered) {
  if (hasLeft()) {
    tellPeople("the node under test has left: it is started anew");
    needs_restart_ = true;  // its launch file may go on without it
  }
  unanswered_ = is_answered ? 0 : unanswered_ + 1;
  if (is_answered || hasLeft()) return;
  const bool is_silent = parameters_.restart_after > 0 && unanswered_ >= parameters_.restart_after;
  const bool is_hanging = isHanging();
  if (!is_silent && !is_hanging) return;
  tellPeople(std::string("the node under test ") +
             (is_hanging ? "hangs"
                         : "has not answered " + std::to_string(unanswered_) +
                               (unanswered_ == 1 ? " problem" : " problems")) +
             ": it is restarted");
  needs_restart_ = true;
  unanswered_ = 0;
}

std::optional<ProcessUsage> NodeMonitor::usage() { return processes_.usage(inputs_.allNodes()); }

}  // namespace pcrb
