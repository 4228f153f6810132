#include "verdict/run_watcher.hpp"

#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/service.h>
#include <std_srvs/Trigger.h>

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_server/topics.hpp"

namespace pcrb {

namespace {

constexpr double kListenPeriod = 0.1;  // s
constexpr double kLookPeriod = 0.5;    // s between looks for the nodes
constexpr double kStartLimit = 60.0;   // s until a node's process has registered
constexpr int kAbsences = 3;  // looks in vain, during which the last message of a server arrives

double secondsBetween(std::chrono::steady_clock::time_point from,
                      std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

RunWatcher::RunWatcher(const std::string& server, const std::vector<std::string>& clients)
    : server_(node_.resolveName(server)) {
  for (const auto& client : clients) clients_.push_back({node_.resolveName(client)});
  ros::master::setRetryTimeout(ros::WallDuration(5.0));
  summary_subscriber_ = node_.subscribe<pcrb_msgs::Summary>(
      topics::kSummary, 1,
      [this](const pcrb_msgs::SummaryConstPtr& message) { summary_ = message; });
  result_subscriber_ = node_.subscribe<pcrb_msgs::Result>(
      topics::kResult, 1, [this](const pcrb_msgs::ResultConstPtr& message) { newest_ = message; });
}

void RunWatcher::listen() {
  ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kListenPeriod));
}

void RunWatcher::startRun() {
  if (is_started_ || summary_subscriber_.getNumPublishers() == 0) return;
  const std::string service = ros::names::append(server_, services::kStart);
  std_srvs::Trigger start;
  is_started_ = ros::service::exists(service, false) && ros::service::call(service, start);
}

RunWatcher::Server RunWatcher::lookForServer() const {
  // A killed process stays registered; only its service's port tells. A server that is still
  // reading its files has no services yet.
  if (ros::service::exists(services::kReady, false)) return Server::kServing;
  ros::V_string nodes;
  const bool is_registered =
      ros::master::getNodes(nodes) && std::find(nodes.begin(), nodes.end(), server_) != nodes.end();
  return is_registered ? Server::kRegistered : Server::kAbsent;
}

bool RunWatcher::hasServerEnded() {
  const Server found = lookForServer();
  absences_ = found < seen_ ? absences_ + 1 : 0;
  seen_ = std::max(seen_, found);
  return absences_ >= kAbsences;
}

void RunWatcher::lookForClients(double waited) {
  ros::V_string nodes;
  if (clients_.empty() || !ros::master::getNodes(nodes)) return;
  for (auto& client : clients_) {
    const bool is_there = std::find(nodes.begin(), nodes.end(), client.name) != nodes.end();
    client.is_seen |= is_there;
    client.absences = is_there ? 0 : client.absences + 1;
    if (client.is_seen && client.absences >= kAbsences) {
      fail(client.name + " gave up: see what it printed");
    }
    if (!client.is_seen && waited > kStartLimit) {
      fail(client.name + " did not start: see what it printed");
    }
  }
}

void RunWatcher::look(double waited) {
  looked_ = Clock::now();
  if (hasServerEnded()) fail(server_ + " died or gave up: see what it printed");
  if (seen_ == Server::kAbsent && waited > kStartLimit) {
    fail(server_ + " did not start: see what it printed");
  }
  lookForClients(waited);
}

pcrb_msgs::Summary RunWatcher::wait(double limit, const ShutdownRequest& shutdown) {
  const auto start = Clock::now();
  while (!summary_) {
    listen();
    if (summary_) break;
    startRun();
    if (shutdown.requested()) fail("this was ended by a signal");
    const double waited = secondsBetween(start, Clock::now());
    if (secondsBetween(looked_, Clock::now()) >= kLookPeriod) look(waited);
    if (waited > limit) {
      fail("it was not over within " + formatShortest(limit) + " s (time_limit_total)");
    }
  }
  if (!summary_->finished) fail(server_ + " was stopped");
  return *summary_;
}

void RunWatcher::fail(const std::string& what) const {
  const std::string done =
      newest_ ? std::to_string(newest_->index + 1) + " of " + std::to_string(newest_->count)
              : "none";
  throw Error("the run did not finish: " + what + "; problems with a result: " + done);
}

}  // namespace pcrb
