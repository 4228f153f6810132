#include "server/benchmark_server.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <thread>

#include "pcrb_core/run/scoring.hpp"
#include "pcrb_core/run/summary.hpp"
#include "pcrb_server/topics.hpp"
#include "ros/node_calls.hpp"
#include "ros/notices.hpp"
#include "server/run_console.hpp"

namespace pcrb {

namespace {

constexpr std::uint32_t kServiceThreads = 4;
constexpr auto kPollPeriod = std::chrono::milliseconds(20);

std::vector<PlannedProblem> withoutFinished(std::vector<PlannedProblem> problems,
                                            const std::set<ProblemKey>& finished) {
  const auto is_finished = [&](const PlannedProblem& planned) {
    return finished.count(planned.key) > 0;
  };
  problems.erase(std::remove_if(problems.begin(), problems.end(), is_finished), problems.end());
  return problems;
}

}  // namespace

BenchmarkServer::BenchmarkServer(const ServerParameters& parameters, ShutdownRequest& shutdown)
    : parameters_(parameters),
      shutdown_(shutdown),
      plan_(makeRunPlan(parameters.configuration.selection)),
      record_(parameters.run, parameters.configuration, plan_),
      remaining_(
          withoutFinished(inServingOrder(plan_.problems, record_.secret()), record_.finished())),
      done_(plan_.problems.size() - remaining_.size()),
      is_paused_(!parameters.autostart),
      tf_(parameters.frames.map, std::max(parameters.connect_limit, parameters.ready_limit) +
                                     parameters.configuration.time_limit + 10.0),
      session_(parameters.frames.map, std::ref(tf_), parameters.configuration.handshake),
      publications_(node_, parameters),
      clients_(parameters, session_, publications_, shutdown, record_),
      loader_(parameters, record_.secret(), remaining_),
      spinner_(1),
      service_spinner_(kServiceThreads, &service_queue_) {
  loader_.checkFrames();
  offerServices();
  shutdown_.onShutdown([this] { session_.stop(); });
  spinner_.start();
  service_spinner_.start();
}

BenchmarkServer::~BenchmarkServer() {
  shutdown_.forget();
  session_.stop();
  service_spinner_.stop();
  spinner_.stop();
}

void BenchmarkServer::offerServices() {
  ros::NodeHandle node;
  node.setCallbackQueue(&service_queue_);
  using ReadyEvent = ros::ServiceEvent<pcrb_msgs::Ready::Request, pcrb_msgs::Ready::Response>;
  services_.push_back(
      node.advertiseService<ReadyEvent>(services::kReady, [this](ReadyEvent& event) {
        session_.ready(event.getCallerName(), event.getRequest(), event.getResponse());
        return true;
      }));
  using pcrb_msgs::SubmitPose;
  using SubmitEvent = ros::ServiceEvent<SubmitPose::Request, SubmitPose::Response>;
  services_.push_back(
      node.advertiseService<SubmitEvent>(services::kSubmitPose, [this](SubmitEvent& event) {
        session_.submit(event.getCallerName(), event.getRequest(), event.getResponse());
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
    return session_.skip() ? TriggerAnswer{true, "the problem in flight is skipped"}
                           : TriggerAnswer{false, "no problem is in flight"};
  }));
}

bool BenchmarkServer::run() {
  std::cout << describe(parameters_) << std::endl;
  RunProgress progress(done_, plan_.problems.size());
  if (is_paused_) tellPeople(describeWaitForStart());
  waitForStart();  // also if nothing remains: who starts it wants to read the summary
  const bool has_handshake = parameters_.configuration.handshake == Handshake::kReady;
  if (remaining_.empty() && has_handshake) clients_.checkThoseOfFinishedRun();
  for (std::size_t i = 0; i < remaining_.size(); ++i) {
    waitForStart();
    if (!has_handshake) clients_.waitForSubscriber();
    if (shutdown_.requested() || !serve(loader_.next())) break;
    progress.add();
  }
  return conclude();
}

void BenchmarkServer::waitForStart() {
  while (is_paused_ && !shutdown_.requested()) std::this_thread::sleep_for(kPollPeriod);
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
  session_.announce(announcement.problem_id, announcement.stamp);
  publications_.publishProblem(prepared, announcement);
  if (!clients_.waitForReady()) return false;
  session_.startClock(std::chrono::duration<double>(parameters_.configuration.time_limit));
  publications_.publishSource(prepared, announcement);
  Reply reply;
  if (session_.waitReply(reply) == ProblemSession::Wait::kStopped) return false;
  loader_.prepareAnother();
  const Result result = score(prepared, reply);
  record_.add(result);
  record_.noteUsage(reply.cpu_time, reply.peak_memory);
  ++done_;
  publications_.publishResult(prepared, announcement, result);
  return true;
}

/// @param had_readers  before the summary was published: they may have left by now.
/// @param departures   of readers, up to then: one that comes and leaves between two looks counts.
void BenchmarkServer::waitForReaders(bool had_readers, int departures) {
  const auto end =
      ProblemSession::Clock::now() + std::chrono::duration<double>(parameters_.summary_hold_time);
  while (!shutdown_.requested() && ProblemSession::Clock::now() < end) {
    const bool has_readers = publications_.hasSummaryReaders();
    had_readers = had_readers || publications_.summaryDepartures() > departures;
    if (had_readers && !has_readers) return;  // clients have read it and ended
    had_readers = has_readers;
    std::this_thread::sleep_for(kPollPeriod);
  }
}

bool BenchmarkServer::conclude() {
  session_.endRun();
  record_.noteForeignReplies(session_.foreignReplies());
  const auto results = record_.results();
  const auto summaries = summarize(results);
  const bool is_finished = done_ == plan_.problems.size();
  const std::string table = formatSummary(summaries) + describeScans(results);
  if (is_finished) record_.writeExports(table);
  const std::size_t skipped =
      parameters_.allow_skipped
          ? 0
          : summaries.back().outcomes.at(static_cast<std::size_t>(Outcome::kSkipped));
  std::cout << describeEnd(parameters_, table, done_, plan_.problems.size())
            << describeDoubts(session_.foreignReplies(), skipped) << std::flush;
  const bool has_readers = publications_.hasSummaryReaders();
  const int departures = publications_.summaryDepartures();
  if (is_finished) publications_.publishErrors();
  publications_.publishSummary(summaries, is_finished);
  if (is_finished) waitForReaders(has_readers, departures);
  return is_finished && skipped == 0;
}

}  // namespace pcrb
