#include "bridge/scan_sequence.hpp"

#include <algorithm>
#include <cstdlib>

namespace pcrb {

ScanSequence::ScanSequence(const ScanPolicy& policy, const SettlingRule& rule,
                           const std::optional<Transform>& initial_pose, double now)
    : policy_(policy), rule_(rule), settling_(rule, initial_pose), start_(now) {}

/// Whether the last scan that counts, and the one after it if it is needed, have been sent.
bool ScanSequence::isLastScanOut() const {
  if (rule_.kind == SettlingRule::Kind::kDeadline) return false;
  const auto& latest = settling_.latest();
  const bool is_last_answered = latest && latest->scan >= policy_.max_scans;
  return scansSent() > policy_.max_scans || is_last_answered;
}

bool ScanSequence::isOver(double now) const {
  if (now - start_ >= policy_.deadline) return true;
  if (!isLastScanOut()) return false;
  const auto& latest = settling_.latest();
  return (latest && latest->scan >= policy_.max_scans) || now - last_sent_ >= policy_.answer_limit;
}

bool ScanSequence::mayBeSent(double now) const {
  if (stamps_.empty()) return true;
  if (isLastScanOut()) return false;
  return now - last_sent_ >= (is_answered_ ? policy_.period : policy_.answer_limit);
}

ScanSequence::Action ScanSequence::next(double now) const {
  if (settling_.isSettled()) return Action::kSubmit;
  if (isOver(now)) return settling_.latest() ? Action::kSubmit : Action::kGiveUp;
  return mayBeSent(now) ? Action::kSendScan : Action::kWait;
}

double ScanSequence::patience(double now) const {
  const double until_deadline = start_ + policy_.deadline - now;
  if (stamps_.empty()) return 0.0;
  const double until_scan =
      last_sent_ + (is_answered_ ? policy_.period : policy_.answer_limit) - now;
  return std::max(0.0, std::min(until_deadline, until_scan));
}

void ScanSequence::scanSent(double now, std::int64_t stamp) {
  last_sent_ = now;
  is_answered_ = false;
  stamps_.push_back(stamp);
}

int ScanSequence::scanOf(std::int64_t stamp) const {
  if (!policy_.match_by_stamp) return scansSent();
  for (int scan = scansSent(); scan > 0; --scan) {
    if (std::abs(stampOf(scan) - stamp) <= policy_.stamp_tolerance) return scan;
  }
  return 0;
}

bool ScanSequence::answerReceived(std::int64_t stamp, const Transform& T_map_body,
                                  const std::optional<std::array<double, 36>>& covariance) {
  const int scan = scanOf(stamp);
  if (scan == 0) return false;
  is_answered_ = true;
  const bool counts = rule_.kind == SettlingRule::Kind::kDeadline || scan <= policy_.max_scans ||
                      !policy_.match_by_stamp;
  if (counts) settling_.add({scan, T_map_body, covariance});
  return true;
}

std::string ScanSequence::reason(double now) const {
  const std::string scans = std::to_string(scansSent()) + (scansSent() == 1 ? " scan" : " scans");
  if (!settling_.latest()) {
    return settling_.hasEchoed() ? "the node said nothing but the initial pose, once, to " + scans
                                 : "the node said nothing to " + scans;
  }
  if (settling_.isSettled() || rule_.kind == SettlingRule::Kind::kDeadline) return "";
  return "not settled after " + scans +
         (now - start_ >= policy_.deadline ? ", at the deadline" : "") + ": the last answer";
}

}  // namespace pcrb
