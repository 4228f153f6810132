#include "verdict/run_watcher.hpp"

#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/service.h>

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_server/topics.hpp"

namespace pcrb {

namespace {

constexpr double kListenPeriod = 0.1;  // s
constexpr double kLookPeriod = 0.5;    // s between looks for the server
constexpr double kStartLimit = 30.0;   // s until the server's process has registered
constexpr int kAbsences = 3;  // looks in vain, during which the last message of a server arrives

double secondsBetween(std::chrono::steady_clock::time_point from,
                      std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

RunWatcher::RunWatcher(const std::string& server) : server_(node_.resolveName(server)) {
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
  const auto now = Clock::now();
  if (secondsBetween(looked_, now) < kLookPeriod) return false;
  looked_ = now;
  const Server found = lookForServer();
  absences_ = found < seen_ ? absences_ + 1 : 0;
  seen_ = std::max(seen_, found);
  return absences_ >= kAbsences;
}

pcrb_msgs::Summary RunWatcher::wait(double limit, const ShutdownNotice& shutdown) {
  const auto start = Clock::now();
  while (!summary_) {
    listen();
    const double waited = secondsBetween(start, Clock::now());
    if (summary_) break;
    if (shutdown.requested()) fail("this was ended by a signal");
    if (hasServerEnded()) fail(server_ + " died or gave up: see what it printed");
    if (seen_ == Server::kAbsent && waited > kStartLimit) {
      fail(server_ + " did not start: see what it printed");
    }
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
