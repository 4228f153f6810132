#include "server/run_clients.hpp"

#include <ros/names.h>
#include <ros/param.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <locale>
#include <sstream>
#include <thread>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_server/topics.hpp"
#include "ros/topic_peers.hpp"

namespace pcrb {

namespace {

using Clock = ProblemSession::Clock;

constexpr auto kClientPollPeriod = std::chrono::milliseconds(20);
constexpr double kReminderPeriod = 5.0;  // s

std::string joinNames(const std::set<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : " ") + name;
  return text.empty() ? "nobody" : text;
}

/// Who subscribed; where nobody did, also who waits in another namespace.
std::string describeListeners(const std::set<std::string>& names) {
  std::string text = joinNames(names);
  if (!names.empty()) return text;
  for (const auto& node : subscribersElsewhere(topics::kProblem)) text += "; but " + node;
  return text;
}

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

std::string parametersOf(const std::string& node) {
  XmlRpc::XmlRpcValue value;
  if (!ros::param::get(node, value)) return "";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  value.write(text);
  return text.str();
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
  while (true) {
    const double rest = limit - secondsSince(start);
    const auto wait =
        session_.waitReady(std::chrono::duration<double>(std::min(rest, kReminderPeriod)));
    if (wait == ProblemSession::Wait::kStopped) return false;
    if (wait != ProblemSession::Wait::kLimit) break;
    if (rest <= kReminderPeriod) giveUp(limit, is_first);
    std::cout << "waiting for a client to call " << ros::names::resolve(services::kReady)
              << " (subscribed: " << describeListeners(publications_.listeners()) << ")"
              << std::endl;
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
  record_.noteClient(joinNames(names), parameters);
}

void RunClients::checkThoseOfFinishedRun() {
  const std::set<std::string> clients = record_.clients();
  const auto start = Clock::now();
  while (!shutdown_.requested() && secondsSince(start) < parameters_.summary_hold_time) {
    for (const auto& name : publications_.listeners()) {
      if (clients.count(name) > 0) return record_.noteClient(name, parametersOf(name));
    }
    std::this_thread::sleep_for(kClientPollPeriod);
  }
}

}  // namespace pcrb
