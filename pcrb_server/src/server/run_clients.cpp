#include "server/run_clients.hpp"

#include <ros/init.h>
#include <ros/names.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include <algorithm>
#include <chrono>
#include <locale>
#include <sstream>
#include <thread>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_server/topics.hpp"
#include "ros/notices.hpp"
#include "ros/topic_peers.hpp"

namespace pcrb {

namespace {

using Clock = ProblemSession::Clock;

constexpr auto kClientPollPeriod = std::chrono::milliseconds(20);
constexpr double kReminderPeriod = 5.0;                      // s
constexpr auto kProvenanceLimit = std::chrono::seconds(30);  // for node_supervisor to note it

std::string joinNames(const std::set<std::string>& names) {
  return names.empty() ? "nobody" : joined(names, " ");
}

/// Other nodes that publish what the server publishes, each with its topic; empty for none.
std::string conflictingPublishers() {
  std::vector<std::string> owned;
  for (const char* topic : {topics::kProblem, topics::kTarget, topics::kSource}) {
    owned.push_back(ros::names::resolve(topic));
  }
  ConflictingPublishers conflicts(ros::this_node::getName(), owned, "", nullptr);
  std::string found;
  for (const std::string& conflict : conflicts.find(publishersByTopic())) found += "; " + conflict;
  return found;
}

/// What is not one of the bridge's parameters in a recipe that was loaded whole: words about it.
bool isOfARecipe(const std::string& name) {
  return startsWith(name, "recipe/") && !startsWith(name, "recipe/bridge/");
}

/// A parameter and those below it, `name: value` each, a line each.
std::string linesOf(const std::string& name, XmlRpc::XmlRpcValue& value) {
  std::string lines;
  if (value.getType() == XmlRpc::XmlRpcValue::TypeStruct) {
    const std::string above = name.empty() ? "" : name + "/";
    for (auto& [key, below] : value) lines += linesOf(above + key, below);
    return lines;
  }
  if (isOfARecipe(name)) return lines;
  std::ostringstream written;
  written.imbue(std::locale::classic());
  value.write(written);
  const std::string text = written.str();
  if (text.find('\n') == std::string::npos) return name + ": " + printableText(text) + "\n";
  std::istringstream list(text);  // of parameters in their turn
  for (std::string line; std::getline(list, line);) lines += printableText(line) + "\n";
  return lines;
}

/// What node_supervisor has noted of the node under test, a line each; empty without one.
std::string provenanceOfNode() {
  const auto end = Clock::now() + kProvenanceLimit;
  while (ros::param::has(ros::names::resolve("node_supervisor/launch")) &&
         !ros::param::has(ros::names::resolve("node_supervisor/provenance")) &&
         Clock::now() < end && ros::ok()) {
    std::this_thread::sleep_for(kClientPollPeriod);
  }
  XmlRpc::XmlRpcValue lines;
  if (!ros::param::get(ros::names::resolve("node_supervisor/provenance"), lines)) return "";
  std::string text;
  for (int i = 0; i < lines.size(); ++i) text += "node " + std::string(lines[i]) + "\n";
  return text;
}

/// The subscribers; where there are none, also those that wait in another namespace; and what else
/// the master says of why no client may come.
std::string describeListeners(const std::set<std::string>& names) try {
  std::string text = joinNames(names);
  if (names.empty()) {
    for (const auto& node : subscribersElsewhere(topics::kProblem)) text += "; but " + node;
  }
  return text + conflictingPublishers();
} catch (const Error& error) {  // a run goes on with what it has
  return joinNames(names) + "; " + error.what();
}

/// The bridge tells people itself what it waits for before it calls.
bool isBridgeAmong(const std::set<std::string>& nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [](const std::string& node) {
    return node.substr(node.rfind('/') + 1) == "localization_bridge";
  });
}

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

std::string parametersOf(const std::string& node) {
  XmlRpc::XmlRpcValue value;
  std::string ignored;
  const bool has_parameters = ros::names::validate(node, ignored) && ros::param::get(node, value);
  return has_parameters ? linesOf("", value) : "";
}

RunClients::RunClients(const ServerParameters& parameters, ProblemSession& session,
                       const Publications& publications, const ShutdownRequest& shutdown,
                       RunRecord& record)
    : parameters_(parameters),
      session_(session),
      publications_(publications),
      shutdown_(shutdown),
      record_(record) {}

bool RunClients::waitForReady() {
  if (parameters_.configuration.handshake == Handshake::kNone) return true;
  const bool is_first = session_.client().empty();
  const double limit = is_first ? parameters_.connect_limit : parameters_.ready_limit;
  const auto start = Clock::now();
  Notice notice;
  while (true) {
    const double rest = limit - secondsSince(start);
    const auto wait =
        session_.waitReady(std::chrono::duration<double>(std::min(rest, kReminderPeriod)));
    if (wait == ProblemSession::Wait::kStopped) return false;
    if (wait != ProblemSession::Wait::kLimit) break;
    if (rest <= kReminderPeriod) giveUp(limit, is_first);
    const auto listeners = publications_.listeners();
    const std::string text = "waiting for a client to call " +
                             ros::names::resolve(services::kReady) +
                             " (subscribed: " + describeListeners(listeners) + ")";
    if (!isBridgeAmong(listeners)) notice.tell(text);
  }
  if (!session_.client().empty()) note({session_.client()});  // empty: it was skipped
  return true;
}

void RunClients::giveUp(double limit, bool is_first) const {
  throw Error("no client called `" + ros::names::resolve(services::kReady) + "` within " +
              formatShortest(limit) + " s (" + (is_first ? "~connect_limit" : "~ready_limit") +
              "; subscribed to `" + ros::names::resolve(topics::kProblem) +
              "`: " + describeListeners(publications_.listeners()) +
              "); results so far are kept: start again with the same ~run to go on");
}

void RunClients::waitForSubscriber() {
  const auto start = Clock::now();
  while (publications_.listeners().empty() && !shutdown_.requested()) {
    if (secondsSince(start) > parameters_.connect_limit) {
      throw Error("no client subscribed to `" + ros::names::resolve(topics::kProblem) +
                  "` within " + formatShortest(parameters_.connect_limit) +
                  " s (~connect_limit); rviz, rosbag and rostopic do not count");
    }
    std::this_thread::sleep_for(kClientPollPeriod);
  }
  // Those of the first problem: whoever only looks may come later.
  if (noted_.empty() && !shutdown_.requested()) note(publications_.listeners());
}

void RunClients::note(const std::set<std::string>& names) {
  if (names == noted_) return;
  noted_ = names;
  std::string parameters;
  for (const auto& name : names) parameters += parametersOf(name);
  parameters += provenanceOfNode();
  record_.noteClient(joinNames(names), parameters);
}

void RunClients::checkThoseOfFinishedRun() {
  const std::set<std::string> clients = record_.clients();
  const auto start = Clock::now();
  while (!shutdown_.requested() && secondsSince(start) < parameters_.summary_hold_time) {
    for (const auto& name : publications_.listeners()) {
      if (clients.count(name) > 0)
        return record_.noteClient(name, parametersOf(name) + provenanceOfNode());
    }
    std::this_thread::sleep_for(kClientPollPeriod);
  }
}

}  // namespace pcrb
