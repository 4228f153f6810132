#include "server/problem_session.hpp"

#include <algorithm>
#include <cmath>

#include "pcrb_core/io/text.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

using Request = pcrb_msgs::SubmitPose::Request;
using Response = pcrb_msgs::SubmitPose::Response;

std::chrono::steady_clock::duration steady(std::chrono::duration<double> duration) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(duration);
}

Rejection notYours(const std::string& client) {
  return {Response::NOT_YOURS, "the problem belongs to " + client + ", which called `ready`"};
}

Rejection duplicate() { return {Response::DUPLICATE, "the problem has been answered already"}; }

}  // namespace

ProblemSession::ProblemSession(std::string target_frame, Lookup lookup, Handshake handshake)
    : target_frame_(std::move(target_frame)), lookup_(std::move(lookup)), handshake_(handshake) {}

void ProblemSession::announce(const std::string& problem_id, const ros::Time& stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  phase_ = Phase::kAnnounced;
  problem_id_ = problem_id;
  stamp_ = stamp;
  is_ready_ = false;
  is_skipped_ = false;
  rejected_ = 0;
  last_rejection_.clear();
  reply_.reset();
}

ProblemSession::Wait ProblemSession::waitFor(std::unique_lock<std::mutex>& lock,
                                             Clock::time_point deadline,
                                             const std::function<bool()>& done) {
  changed_.wait_until(lock, deadline, [&] { return done() || is_skipped_ || is_stopped_; });
  if (done()) return Wait::kDone;  // also if stopped: a reply that was accepted is kept
  if (is_stopped_) return Wait::kStopped;
  return is_skipped_ ? Wait::kSkipped : Wait::kLimit;
}

ProblemSession::Wait ProblemSession::waitReady(std::chrono::duration<double> limit) {
  std::unique_lock<std::mutex> lock(mutex_);
  return waitFor(lock, Clock::now() + steady(limit), [this] { return is_ready_; });
}

void ProblemSession::startClock(std::chrono::duration<double> limit) {
  const std::lock_guard<std::mutex> lock(mutex_);
  phase_ = Phase::kSourcePublished;
  published_ = Clock::now();
  deadline_ = published_ + steady(limit);
}

ProblemSession::Wait ProblemSession::waitReply(Reply& reply) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto is_answered = [this] { return reply_.has_value(); };
  Wait wait = waitFor(lock, deadline_, is_answered);
  while (wait == Wait::kLimit && looking_up_ > 0) {  // for replies that came in time
    changed_.wait(lock);
    wait = waitFor(lock, deadline_, is_answered);
  }
  reply = reply_.value_or(Reply());
  reply.rejected = rejected_;
  if (wait == Wait::kSkipped) {
    reply.outcome = Outcome::kSkipped;
    reply.reason = "skipped on request";
  } else if (wait == Wait::kLimit) {
    reply.outcome = rejected_ > 0 ? Outcome::kRejected : Outcome::kTimedOut;
    reply.reason = rejected_ > 0 ? last_rejection_ : "no reply within the time limit";
  }
  phase_ = Phase::kIdle;
  ended_[problem_id_] = wait == Wait::kDone;
  return wait;
}

void ProblemSession::endRun() {
  const std::lock_guard<std::mutex> lock(mutex_);
  phase_ = Phase::kRunOver;
}

void ProblemSession::ready(const std::string& caller, const pcrb_msgs::Ready::Request& request,
                           pcrb_msgs::Ready::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!isNodeName(caller)) {
    response.message = "found a caller named " + inQuotes(caller) + ", expected a node's name";
  } else if (!inFlight(request.problem_id)) {
    response.message = "found problem_id " + inQuotes(request.problem_id) +
                       ", expected that of the problem announced last";
  } else if (phase_ != Phase::kAnnounced) {
    response.message = "the problem's source has been published already";
  } else if (is_ready_ && caller != client_) {
    response.message = "the problem belongs to " + client_ + ", which called first";
  } else {
    response.accepted = 1;
    is_ready_ = true;
    client_ = caller;
    changed_.notify_all();
  }
}

bool ProblemSession::inFlight(const std::string& problem_id) const {
  return (phase_ == Phase::kAnnounced || phase_ == Phase::kSourcePublished) &&
         problem_id == problem_id_;
}

std::optional<Rejection> ProblemSession::check(const std::string& problem_id,
                                               Clock::time_point arrival) const {
  const auto ended = ended_.find(problem_id);
  if (ended != ended_.end()) {
    if (ended->second) return duplicate();
    return Rejection{Response::LATE, "the problem has ended"};
  }
  if (phase_ == Phase::kRunOver) return Rejection{Response::NOT_RUNNING, "the run is over"};
  if (!inFlight(problem_id)) {
    return Rejection{Response::UNKNOWN_PROBLEM, "found problem_id " + inQuotes(problem_id) +
                                                    ", expected that of an announced problem"};
  }
  if (phase_ == Phase::kAnnounced) {
    return Rejection{Response::NOT_RUNNING,
                     "the problem's source has not been published: call `ready` first"};
  }
  if (reply_) return duplicate();
  if (arrival > deadline_) return Rejection{Response::LATE, "the time limit is over"};
  return std::nullopt;
}

bool ProblemSession::isElsewhere(const Request& request) const {
  const std::string frame = withoutSlash(request.pose.header.frame_id);
  return !frame.empty() && frame != target_frame_;
}

Rejection ProblemSession::noTransform(const Request& request) const {
  return {Response::NO_TRANSFORM, "tf does not connect " +
                                      inQuotes(withoutSlash(request.pose.header.frame_id)) +
                                      " with '" + target_frame_ + "'"};
}

/// Lets others in while a reply waits for tf, and counts it among those that waitReply() waits for,
/// until its look-up is over, however that ends.
class ProblemSession::LookingUp {
 public:
  LookingUp(ProblemSession& session, std::unique_lock<std::mutex>& lock)
      : session_(session), lock_(lock) {
    ++session_.looking_up_;
    lock_.unlock();
  }
  ~LookingUp() {
    lock_.lock();
    --session_.looking_up_;
    session_.changed_.notify_all();
  }
  LookingUp(const LookingUp&) = delete;
  LookingUp& operator=(const LookingUp&) = delete;

 private:
  ProblemSession& session_;
  std::unique_lock<std::mutex>& lock_;
};

std::optional<Transform> ProblemSession::toTarget(const Request& request,
                                                  std::unique_lock<std::mutex>& lock) {
  const ros::Time stamp = stamp_;  // another thread's, once the lock is open
  const LookingUp looking_up(*this, lock);
  const std::string frame = withoutSlash(request.pose.header.frame_id);
  const bool has_stamp = !request.pose.header.stamp.isZero();
  return lookup_(frame, has_stamp ? request.pose.header.stamp : stamp);
}

/// Finds T_target_frame for a pose in another frame than the target's; others may call meanwhile.
std::optional<Rejection> ProblemSession::place(const Request& request, const Submission& submission,
                                               Clock::time_point arrival,
                                               std::unique_lock<std::mutex>& lock,
                                               std::optional<Transform>& T_target_frame) {
  if (submission.status != Submission::Status::kPose || !isElsewhere(request)) return std::nullopt;
  T_target_frame = toTarget(request, lock);
  if (auto rejection = check(request.problem_id, arrival)) return rejection;  // it may have ended
  if (!T_target_frame) return noTransform(request);
  return toRejection(checkPlaced(submission, *T_target_frame));
}

bool ProblemSession::isForeign(const std::string& caller) const {
  return handshake_ == Handshake::kReady && caller != client_;
}

void ProblemSession::submit(const std::string& caller, const Request& request, Response& response) {
  const Clock::time_point arrival = Clock::now();
  std::unique_lock<std::mutex> lock(mutex_);
  Submission submission;
  std::optional<Transform> T_target_frame;
  const bool is_foreign = inFlight(request.problem_id) && isForeign(caller);
  auto rejection = check(request.problem_id, arrival);
  if (is_foreign && phase_ == Phase::kSourcePublished) rejection = notYours(client_);
  if (!rejection) rejection = readSubmission(request, submission);
  if (!rejection) rejection = place(request, submission, arrival, lock, T_target_frame);
  response.accepted = rejection ? 0 : 1;
  response.code = rejection ? rejection->code : std::uint8_t{Response::OK};
  if (!rejection) {
    accept(submission, arrival, T_target_frame);
    return;
  }
  response.message = rejection->message;
  if (is_foreign) {
    ++foreign_replies_;
  } else if (inFlight(request.problem_id) && !reply_) {
    ++rejected_;
    last_rejection_ = rejection->message;
  }
}

void ProblemSession::accept(const Submission& submission, Clock::time_point arrival,
                            const std::optional<Transform>& T_target_frame) {
  Reply reply = makeReply(submission, T_target_frame);
  reply.runtime = std::chrono::duration<double>(arrival - published_).count();
  reply_ = reply;
  changed_.notify_all();
}

bool ProblemSession::skip() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool is_in_flight = inFlight(problem_id_) && !reply_;
  if (is_in_flight) is_skipped_ = true;
  changed_.notify_all();
  return is_in_flight;
}

void ProblemSession::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_stopped_ = true;
  changed_.notify_all();
}

std::string ProblemSession::client() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return client_;
}

std::uint64_t ProblemSession::foreignReplies() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return foreign_replies_;
}

}  // namespace pcrb
