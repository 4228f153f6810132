#include "server/benchmark_server.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <thread>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_server/topics.hpp"
#include "ros/node_calls.hpp"
#include "server/client_parameters.hpp"
#include "server/scoring.hpp"

namespace pcrb {

namespace {

constexpr std::uint32_t kServiceThreads = 4;
constexpr auto kPollPeriod = std::chrono::milliseconds(20);
constexpr double kReminderPeriod = 5.0;  // s

std::vector<PlannedProblem> withoutFinished(std::vector<PlannedProblem> problems,
                                            const std::set<ProblemKey>& finished) {
  const auto is_finished = [&](const PlannedProblem& planned) {
    return finished.count(planned.key) > 0;
  };
  problems.erase(std::remove_if(problems.begin(), problems.end(), is_finished), problems.end());
  return problems;
}

std::string join(const std::set<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : " ") + name;
  return text.empty() ? "nobody" : text;
}

}  // namespace

BenchmarkServer::BenchmarkServer(const ServerParameters& parameters, ShutdownRequest& shutdown)
    : parameters_(parameters),
      shutdown_(shutdown),
      plan_(makeRunPlan(parameters)),
      record_(parameters, plan_),
      remaining_(
          withoutFinished(inServingOrder(plan_.problems, record_.secret()), record_.finished())),
      done_(plan_.problems.size() - remaining_.size()),
      is_paused_(!parameters.autostart),
      tf_(parameters.map_frame, std::max(parameters.connect_limit, parameters.ready_limit) +
                                    parameters.time_limit + 10.0),
      exchange_(parameters.map_frame, std::ref(tf_)),
      publications_(node_, parameters),
      loader_(parameters, record_.secret(), remaining_),
      spinner_(1),
      service_spinner_(kServiceThreads, &service_queue_) {
  loader_.checkFrames();
  offerServices();
  shutdown_.onShutdown([this] { exchange_.stop(); });
  spinner_.start();
  service_spinner_.start();
}

BenchmarkServer::~BenchmarkServer() {
  shutdown_.forget();
  exchange_.stop();
  service_spinner_.stop();
  spinner_.stop();
}

void BenchmarkServer::offerServices() {
  ros::NodeHandle node;
  node.setCallbackQueue(&service_queue_);
  using ReadyEvent = ros::ServiceEvent<pcrb_msgs::Ready::Request, pcrb_msgs::Ready::Response>;
  services_.push_back(
      node.advertiseService<ReadyEvent>(services::kReady, [this](ReadyEvent& event) {
        exchange_.ready(event.getCallerName(), event.getRequest(), event.getResponse());
        return true;
      }));
  using pcrb_msgs::SubmitPose;
  services_.push_back(node.advertiseService<SubmitPose::Request, SubmitPose::Response>(
      services::kSubmitPose, [this](SubmitPose::Request& request, SubmitPose::Response& response) {
        exchange_.submit(request, response);
        return true;
      }));
  offerControls();
}

void BenchmarkServer::offerControls() {
  ros::NodeHandle node("~");
  node.setCallbackQueue(&service_queue_);
  services_.push_back(offerTrigger(node, services::kStart, [this] {
    is_paused_ = false;
    return TriggerAnswer{true, "running"};
  }));
  services_.push_back(offerTrigger(node, services::kPause, [this] {
    is_paused_ = true;
    return TriggerAnswer{true, "paused after the problem in flight"};
  }));
  services_.push_back(offerTrigger(node, services::kSkip, [this] {
    return exchange_.skip() ? TriggerAnswer{true, "the problem in flight is skipped"}
                            : TriggerAnswer{false, "no problem is in flight"};
  }));
}

bool BenchmarkServer::run() {
  std::cout << describe(parameters_) << std::endl;
  RunProgress progress(done_, plan_.problems.size());
  waitForStart();  // also if nothing remains: who starts it wants to read the summary
  if (remaining_.empty() && parameters_.handshake) {
    checkClientOfFinishedRun(record_, publications_, shutdown_, parameters_.linger);
  }
  for (std::size_t i = 0; i < remaining_.size(); ++i) {
    waitForStart();
    if (!parameters_.handshake) waitForListener();
    if (shutdown_.requested() || !serve(loader_.next())) break;
    progress.add();
  }
  return conclude();
}

void BenchmarkServer::waitForStart() {
  while (is_paused_ && !shutdown_.requested()) std::this_thread::sleep_for(kPollPeriod);
}

void BenchmarkServer::waitForListener() {
  const auto start = Exchange::Clock::now();
  while (publications_.listeners().empty() && !shutdown_.requested()) {
    const std::chrono::duration<double> waited = Exchange::Clock::now() - start;
    if (waited.count() > parameters_.connect_limit) {
      throw Error("no client subscribed to `" + node_.resolveName(topics::kProblem) + "` within " +
                  formatShortest(parameters_.connect_limit) +
                  " s (~connect_limit); rviz, rosbag and rostopic do not count");
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
  // Those of the first problem: whoever only looks may come later.
  if (clients_.empty() && !shutdown_.requested()) noteClients(publications_.listeners());
}

Announcement BenchmarkServer::nextAnnouncement(const PreparedProblem& prepared) {
  last_stamp_ = std::max(ros::Time::now(), last_stamp_ + ros::Duration(0, 1));
  Announcement announcement;
  announcement.problem_id = record_.publicId(*prepared.planned);
  announcement.stamp = last_stamp_;
  announcement.index = static_cast<std::uint32_t>(done_);
  announcement.count = static_cast<std::uint32_t>(plan_.problems.size());
  return announcement;
}

bool BenchmarkServer::serve(PreparedProblem prepared) {
  for (const auto& cloud : {prepared.target, prepared.source}) {
    record_.noteCloud(cloud->name, cloud->hash);
  }
  const Announcement announcement = nextAnnouncement(prepared);
  exchange_.announce(announcement.problem_id, announcement.stamp);
  publications_.announce(prepared, announcement);
  const bool is_waited_for = !parameters_.handshake || waitForClient();
  if (!is_waited_for) return false;
  exchange_.handOut(std::chrono::duration<double>(parameters_.time_limit));
  publications_.handOut(prepared, announcement);
  Reply reply;
  if (exchange_.waitReply(reply) == Exchange::Wait::kStopped) return false;
  loader_.prepareAnother();
  const Result result = scoreReply(prepared, reply);
  record_.add(result);
  record_.noteUsage(reply.cpu_time, reply.peak_memory);
  ++done_;
  publications_.finish(prepared, announcement, result);
  return true;
}

bool BenchmarkServer::waitForClient() {
  const bool is_first = exchange_.client().empty();
  const double limit = is_first ? parameters_.connect_limit : parameters_.ready_limit;
  const auto start = Exchange::Clock::now();
  while (true) {
    const std::chrono::duration<double> waited = Exchange::Clock::now() - start;
    const double rest = limit - waited.count();
    const auto wait =
        exchange_.waitReady(std::chrono::duration<double>(std::min(rest, kReminderPeriod)));
    if (wait == Exchange::Wait::kStopped) return false;
    if (wait != Exchange::Wait::kLimit) break;
    const std::string service = node_.resolveName(services::kReady);
    const std::string listeners = join(publications_.listeners());
    if (rest <= kReminderPeriod) {
      throw Error("no client called `" + service + "` within " + formatShortest(limit) + " s (" +
                  (is_first ? "~connect_limit" : "~ready_limit") + "; subscribed to `" +
                  node_.resolveName(topics::kProblem) + "`: " + listeners +
                  "); results so far are kept: start again with the same ~run to go on");
    }
    std::cout << "waiting for a client to call " << service << " (subscribed: " << listeners << ")"
              << std::endl;
  }
  if (!exchange_.client().empty()) noteClients({exchange_.client()});  // empty: it was skipped
  return true;
}

void BenchmarkServer::noteClients(const std::set<std::string>& names) {
  if (names == clients_) return;
  clients_ = names;
  std::string parameters;
  for (const auto& name : names) parameters += parametersOf(name);
  record_.noteClient(join(names), parameters);
}

/// @param had_readers  before the summary was published: they may have left by now.
void BenchmarkServer::waitForReaders(bool had_readers) {
  const auto end = Exchange::Clock::now() + std::chrono::duration<double>(parameters_.linger);
  while (!shutdown_.requested() && Exchange::Clock::now() < end) {
    const bool has_readers = publications_.hasSummaryReaders();
    if (had_readers && !has_readers) return;  // clients have read it and ended
    had_readers = has_readers;
    std::this_thread::sleep_for(kPollPeriod);
  }
}

bool BenchmarkServer::conclude() {
  exchange_.endRun();
  const auto summaries = record_.summary();
  const bool is_finished = done_ == plan_.problems.size();
  const std::string table = formatSummary(summaries);
  if (is_finished) record_.writeExports(table);
  std::cout << '\n' << table << "results: " << parameters_.run << std::endl;
  if (!is_finished) {
    std::cout << done_ << " of " << plan_.problems.size()
              << " problems have a result; start again with the same ~run to go on" << std::endl;
  }
  const bool has_readers = publications_.hasSummaryReaders();
  publications_.summary(summaries, is_finished);
  if (is_finished) waitForReaders(has_readers);
  return is_finished;
}

}  // namespace pcrb
