#include "bridge/node_keeper.hpp"

#include <std_srvs/Trigger.h>

#include <algorithm>
#include <iostream>

namespace pcrb {

namespace {

constexpr double kSupervisorLimit = 10.0;  // s for the supervisor to come up
constexpr double kQuestionLimit = 0.1;     // s to find out whether there is one
constexpr double kAnswerLimit = 2.0;  // s for a node that did not answer a problem to show life

}  // namespace

NodeKeeper::NodeKeeper(ros::NodeHandle& node, const BridgeParameters& parameters,
                       const NodeInputs& inputs)
    : parameters_(parameters), inputs_(inputs), node_(node) {}

void NodeKeeper::beginProblem(bool is_new_target) {
  using Restart = BridgeParameters::Restart;
  needs_restart_ |= parameters_.restart == Restart::kProblem ||
                    (parameters_.restart == Restart::kTarget && is_new_target);
}

bool NodeKeeper::restart() {
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
  std::cout << "the node under test cannot be restarted: "
            << (is_answered
                    ? service.response.message
                    : "nobody answers on " + client.getService() + " (only under node_supervisor)")
            << std::endl;
  before_.clear();
  return false;
}

bool NodeKeeper::isThere() const {
  const auto nodes = inputs_.nodes();
  return std::any_of(nodes.begin(), nodes.end(), [this](const auto& node) {
    const auto before = before_.find(node.first);
    return before == before_.end() || node.second > before->second;
  });
}

void NodeKeeper::beginWatch() { at_start_ = inputs_.nodes(); }

void NodeKeeper::beginPlay() { processes_.usage(inputs_.allNodes()); }

bool NodeKeeper::hasLeft() const {
  const auto departures = inputs_.departures();
  return std::any_of(departures.begin(), departures.end(), [this](const auto& node) {
    const auto before = at_start_.find(node.first);
    return before != at_start_.end() && node.second > before->second;
  });
}

int NodeKeeper::generation() const {
  int sum = 0;
  for (const auto& [node, departures] : inputs_.departures()) sum += departures;
  return sum;
}

bool NodeKeeper::isHanging() const {
  const auto nodes = inputs_.nodes();
  return std::any_of(nodes.begin(), nodes.end(), [](const auto& node) {
    return !NodeProcesses::isAlive(node.first, kAnswerLimit);
  });
}

void NodeKeeper::endProblem(bool is_answered) {
  if (hasLeft()) {
    std::cout << "the node under test has left: it is started anew" << std::endl;
    needs_restart_ = true;  // its launch file may go on without it
  }
  unanswered_ = is_answered ? 0 : unanswered_ + 1;
  if (is_answered || hasLeft()) return;
  const bool is_silent = parameters_.restart_after > 0 && unanswered_ >= parameters_.restart_after;
  const bool is_hanging = isHanging();
  if (!is_silent && !is_hanging) return;
  std::cout << "the node under test "
            << (is_hanging ? "hangs"
                           : "has not answered " + std::to_string(unanswered_) +
                                 (unanswered_ == 1 ? " problem" : " problems"))
            << ": it is restarted" << std::endl;
  needs_restart_ = true;
  unanswered_ = 0;
}

std::optional<ProcessUsage> NodeKeeper::usage() { return processes_.usage(inputs_.allNodes()); }

}  // namespace pcrb
