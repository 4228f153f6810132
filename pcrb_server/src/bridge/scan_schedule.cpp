#include "bridge/scan_schedule.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "pcrb_core/run/result.hpp"

namespace pcrb {

namespace {

constexpr double kLateFactor = 2.0;  // times as long as an answer took until the next one is late

}  // namespace

double steadyNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ScanSchedule::ScanSchedule(const ScanPolicy& policy, const AcceptanceRule& rule,
                           const std::optional<Transform>& initial_pose, double now,
                           const ResponseTime& known)
    : policy_(policy),
      rule_(rule),
      convergence_(rule, initial_pose),
      start_(now),
      response_time_(known) {}

/// Whether the last scan that counts, and the one after it if it is needed, have been sent.
bool ScanSchedule::isLastScanOut() const {
  if (rule_.kind == AcceptanceRule::Kind::kDeadline) return false;
  const auto& latest = convergence_.latest();
  const bool is_last_answered = latest && latest->scan >= policy_.max_scans;
  return scansSent() > policy_.max_scans || is_last_answered;
}

bool ScanSchedule::isOver(double now) const {
  if (now - start_ >= policy_.deadline) return true;
  if (!isLastScanOut()) return false;
  const auto& latest = convergence_.latest();
  return (latest && latest->scan >= policy_.max_scans) || now - scans_.back().sent >= lateness();
}

/// s after which a scan without an answer is late.
double ScanSchedule::lateness() const {
  return std::max(policy_.answer_limit, kLateFactor * response_time_.latest());
}

/// When the scan after the one sent last is due. One that echoes the initial pose may still answer
/// the same scan, or only the next.
double ScanSchedule::nextScan() const {
  if (policy_.keeps_rate) return scans_.back().sent + policy_.period;
  const bool has_only_echoed = convergence_.hasEchoed() && !convergence_.latest();
  double wait = lateness();
  if (has_only_echoed && response_time_.isKnown()) wait = kLateFactor * response_time_.latest();
  if (is_answered_) wait = 0.0;
  return scans_.back().sent + std::max(policy_.period, wait);
}

ScanSchedule::Action ScanSchedule::next(double now) const {
  if (convergence_.isSettled()) return Action::kSubmit;
  if (isOver(now)) return convergence_.latest() ? Action::kSubmit : Action::kGiveUp;
  if (scans_.empty()) return Action::kSendScan;
  return !isLastScanOut() && now >= nextScan() ? Action::kSendScan : Action::kWait;
}

double ScanSchedule::timeToNext(double now) const {
  if (scans_.empty()) return 0.0;
  return std::max(0.0, std::min(start_ + policy_.deadline, nextScan()) - now);
}

void ScanSchedule::scanSent(double now, std::int64_t stamp) {
  is_answered_ = false;
  Scan& scan = scans_.emplace_back();
  scan.stamp = stamp;
  scan.sent = now;
}

int ScanSchedule::scanOf(std::int64_t stamp) const {
  if (!policy_.match_by_stamp) return scansSent();
  for (int scan = scansSent(); scan > 0; --scan) {
    if (std::abs(stampOf(scan) - stamp) <= policy_.stamp_tolerance) return scan;
  }
  return 0;
}

bool ScanSchedule::answerReceived(double now, std::int64_t stamp, const Transform& T_map_body,
                                  const std::optional<PoseCovariance>& covariance) {
  const int scan = scanOf(stamp);
  if (scan == 0) return false;
  const bool counts = rule_.kind == AcceptanceRule::Kind::kDeadline || scan <= policy_.max_scans ||
                      !policy_.match_by_stamp;
  const bool had_answer = convergence_.latest().has_value();
  const bool is_echo_or_old = counts && !convergence_.add({scan, T_map_body, covariance});
  record(now, scan, T_map_body, is_echo_or_old && !had_answer);
  if (is_echo_or_old) return true;
  is_answered_ = true;
  noteAnswer(now, scan);
  return true;
}

void ScanSchedule::record(double now, int scan, const Transform& T_map_body, bool is_echo) {
  Scan& answered = scans_[static_cast<std::size_t>(scan - 1)];
  answered.answered = now;
  answered.is_echo = is_echo;
  answered.T_map_body = T_map_body;
}

/// Learns from an answer how long the node worked: since it had the scan, and had answered those
/// before.
void ScanSchedule::noteAnswer(double now, int scan) {
  // Where stamps say nothing, the oldest scan without an answer is the one that was worked on.
  if (!policy_.match_by_stamp) scan = std::min(scan, newest_answered_ + 1);
  if (scan <= newest_answered_) return;
  if (scan == scansSent()) response_time_.setHoldsLastScan(false);
  const bool came_with_next = response_time_.holdsLastScan() && scan < scansSent();
  response_time_.add(now -
                     std::max(last_answered_, scanSentAs(came_with_next ? scan + 1 : scan).sent));
  newest_answered_ = scan;
  last_answered_ = now;
}

double ScanSchedule::timeToFinish(double now) const {
  const bool is_only_held =
      response_time_.holdsLastScan() && newest_answered_ > 0 && unanswered() == 1;
  if (unanswered() == 0 || is_only_held) return 0.0;
  const double sent = scans_.back().sent;
  const double work =
      response_time_.isKnown() ? kLateFactor * response_time_.slowest() : sent - start_;
  return std::max(0.0, std::max(sent, last_answered_) + std::max(policy_.answer_limit, work) - now);
}

ResponseTime ScanSchedule::responseTimeAtEnd(double now) const {
  ResponseTime learned = response_time_;
  const bool waited_in_vain = unanswered() == 1 && timeToFinish(now) <= 0.0;
  if (waited_in_vain && newest_answered_ > 0) learned.setHoldsLastScan(true);
  return learned;
}

std::string ScanSchedule::reason(double now) const {
  const std::string scans = std::to_string(scansSent()) + (scansSent() == 1 ? " scan" : " scans");
  if (!convergence_.latest()) {
    return convergence_.hasEchoed()
               ? "the node said nothing but the initial pose, once, to " + scans
               : "the node said nothing to " + scans;
  }
  if (convergence_.isSettled() || rule_.kind == AcceptanceRule::Kind::kDeadline) return "";
  const auto answered = std::count_if(scans_.begin(), scans_.end(),
                                      [](const Scan& scan) { return scan.answered > 0.0; });
  const bool is_mostly_mute = 2 * answered < scansSent();
  return kNotSettled + (" after " + scans) +
         (is_mostly_mute ? ", " + std::to_string(answered) + " of them answered" : "") +
         (now - start_ >= policy_.deadline ? ", at the deadline" : "") + ": the last answer";
}

}  // namespace pcrb
