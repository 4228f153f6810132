#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/run/convergence_monitor.hpp"

namespace pcrb {

/// s on a clock that is never set.
double steadyNow();

/// The time for which a node works on a scan, learned from its answers to the problems so far, s.
class ResponseTime {
 public:
  void add(double work) {
    works_.push_back(work);
    if (works_.size() > kRemembered) works_.pop_front();
  }

  bool isKnown() const { return !works_.empty(); }

  /// For the newest answer, 0 while nothing is known.
  double latest() const { return works_.empty() ? 0.0 : works_.back(); }

  /// For the slowest of the last answers, 0 while nothing is known. A map that is built for the
  /// first scan is forgotten in time.
  double slowest() const {
    return works_.empty() ? 0.0 : *std::max_element(works_.begin(), works_.end());
  }

  /// Whether it answers a scan when the next one comes, and so never the last one.
  bool holdsLastScan() const { return holds_last_scan_; }
  void setHoldsLastScan(bool holds) { holds_last_scan_ = holds; }

 private:
  static constexpr std::size_t kRemembered = 10;

  std::deque<double> works_;
  bool holds_last_scan_ = false;
};

/// How one problem's scan is repeated. Times in s.
struct ScanPolicy {
  double period = 0.1;         ///< least time between two scans
  double answer_limit = 1.0;   ///< least time after which a scan without an answer is late
  int max_scans = 40;          ///< scans whose answers count; not for AcceptanceRule::kDeadline
  double deadline = 9.0;       ///< from start() to the decision
  bool keeps_rate = false;     ///< a scan comes every period, answered or not
  bool match_by_stamp = true;  ///< else an answer belongs to the scan sent last
  std::int64_t stamp_tolerance = 2000;  ///< ns: some nodes carry stamps in µs, or in a double
};

/// Decides when the scan of one problem is sent again, and when the answer is submitted.
///
/// A node with a queue of one loses what comes while it is busy, so that the next scan waits for an
/// answer, or until that is late: after twice the time that the node took for its newest answer, if
/// that is more than the limit. A node that collects scans answers scan k only when scan k + 1
/// comes, so that one more scan is sent after the last one that counts. Times are of any steady
/// clock, stamps are ns.
class ScanSchedule {
 public:
  enum class Action {
    kWait,
    kSendScan,
    kSubmit,  ///< the answer is convergence().latest()
    kGiveUp   ///< time or scans are over and no answer counts; reason() says so
  };

  /// @param known  the node's response time, from the problems before.
  ScanSchedule(const ScanPolicy& policy, const AcceptanceRule& rule,
               const std::optional<Transform>& initial_pose, double now,
               const ResponseTime& known = {});

  Action next(double now) const;

  /// s from `now` after which next() may say something else, if no answer comes.
  double timeToNext(double now) const;

  void scanSent(double now, std::int64_t stamp);

  /// @param stamp  of the answer.
  /// @return  whether it belongs to a scan of this problem.
  bool answerReceived(double now, std::int64_t stamp, const Transform& T_map_body,
                      const std::optional<PoseCovariance>& covariance);

  /// s from `now` for which the node may still be working on a scan, 0 if it has answered the last
  /// one, or holds that until another comes. A node that never answered anything has as long again
  /// as it was sent scans for.
  double timeToFinish(double now) const;

  /// What is known of the node's response time. After timeToFinish() in vain, a node that answered
  /// every scan but the last one is one that holds it.
  ResponseTime responseTimeAtEnd(double now) const;

  const ConvergenceMonitor& convergence() const { return convergence_; }
  int scansSent() const { return static_cast<int>(scans_.size()); }

  /// The stamp of a scan, from 1.
  std::int64_t stampOf(int scan) const { return scanSentAs(scan).stamp; }

  /// A scan of the problem, and its newest answer.
  struct Scan {
    std::int64_t stamp;
    double sent;
    double answered = 0.0;  ///< 0 = not yet
    bool is_echo = false;
    Transform T_map_body = Transform::Identity();
  };

  const std::vector<Scan>& scans() const { return scans_; }

  /// Which scan an answer belongs to, 0 if to none.
  int scanOf(std::int64_t stamp) const;

  /// For people: why there is no answer, or that the answer had not settled. Else empty.
  std::string reason(double now) const;

 private:
  const Scan& scanSentAs(int scan) const { return scans_[static_cast<std::size_t>(scan - 1)]; }
  bool isLastScanOut() const;
  bool isOver(double now) const;
  double nextScan() const;
  double lateness() const;
  void noteAnswer(double now, int scan);
  void record(double now, int scan, const Transform& T_map_body, bool is_echo);
  int unanswered() const { return scansSent() - newest_answered_; }

  ScanPolicy policy_;
  AcceptanceRule rule_;
  ConvergenceMonitor convergence_;
  double start_;
  ResponseTime response_time_;
  std::vector<Scan> scans_;     ///< sent
  bool is_answered_ = false;    ///< whether an answer came since the last scan was sent
  int newest_answered_ = 0;     ///< scan that was answered, an echo excepted, 0 = none
  double last_answered_ = 0.0;  ///< when that was
};

}  // namespace pcrb
