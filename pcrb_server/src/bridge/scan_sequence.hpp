#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bridge/settling.hpp"

namespace pcrb {

/// How one problem's scan is repeated. Times in s.
struct ScanPolicy {
  double period = 0.1;         ///< least time between two scans
  double answer_limit = 1.0;   ///< the next scan comes without an answer after this time
  int max_scans = 40;          ///< scans whose answers count; not for SettlingRule::kDeadline
  double deadline = 9.0;       ///< from start() to the decision
  bool match_by_stamp = true;  ///< else an answer belongs to the scan sent last
  std::int64_t stamp_tolerance = 2000;  ///< ns: some nodes carry stamps in µs, or in a double
};

/// Decides when the scan of one problem is sent again, and when the answer is submitted.
///
/// A node with a queue of one loses what comes while it is busy, so that the next scan waits for an
/// answer or a limit. A node that collects scans answers scan k only when scan k + 1 comes, so that
/// one more scan is sent after the last one that counts. Times are of any steady clock, stamps are
/// ns.
class ScanSequence {
 public:
  enum class Action {
    kWait,
    kSendScan,
    kSubmit,  ///< the answer is settling().latest()
    kGiveUp   ///< time or scans are over and nothing counts; reason() says so
  };

  ScanSequence(const ScanPolicy& policy, const SettlingRule& rule,
               const std::optional<Transform>& initial_pose, double now);

  Action next(double now) const;

  /// s from `now` after which next() may say something else, if no answer comes.
  double patience(double now) const;

  void scanSent(double now, std::int64_t stamp);

  /// @param stamp  of the answer.
  /// @return  whether it belongs to a scan of this problem.
  bool answerReceived(std::int64_t stamp, const Transform& T_map_body,
                      const std::optional<std::array<double, 36>>& covariance);

  const Settling& settling() const { return settling_; }
  int scansSent() const { return static_cast<int>(stamps_.size()); }
  bool isAwaitingAnswer() const { return scansSent() > 0 && !is_answered_; }

  /// The stamp of a scan, from 1.
  std::int64_t stampOf(int scan) const { return stamps_[static_cast<std::size_t>(scan - 1)]; }

  /// Which scan an answer belongs to, 0 if to none.
  int scanOf(std::int64_t stamp) const;

  /// For people: why there is no answer, or that the answer had not settled. Else empty.
  std::string reason(double now) const;

 private:
  bool isLastScanOut() const;
  bool isOver(double now) const;
  bool mayBeSent(double now) const;

  ScanPolicy policy_;
  SettlingRule rule_;
  Settling settling_;
  double start_;
  double last_sent_ = 0.0;
  bool is_answered_ = false;          ///< whether anything was said since the last scan was sent
  std::vector<std::int64_t> stamps_;  ///< of the scans sent
};

}  // namespace pcrb
