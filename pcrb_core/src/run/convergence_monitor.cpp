#include "pcrb_core/run/convergence_monitor.hpp"

#include <algorithm>

namespace pcrb {

bool isNear(const Transform& a, const Transform& b, double translation, double rotation) {
  return (a.translation() - b.translation()).norm() < translation &&
         rotationAngle(a.linear().transpose() * b.linear()) < rotation;
}

ConvergenceMonitor::ConvergenceMonitor(const AcceptanceRule& rule,
                                       const std::optional<Transform>& initial_pose)
    : rule_(rule), initial_pose_(initial_pose) {}

bool ConvergenceMonitor::isEcho(const ScanAnswer& answer) const {
  const bool may_be_first = !latest_ && (echo_scan_ == 0 || echo_scan_ == answer.scan);
  return may_be_first && initial_pose_ &&
         isNear(answer.T_map_body, *initial_pose_, rule_.echo_tolerance, rule_.echo_tolerance);
}

bool ConvergenceMonitor::add(const ScanAnswer& answer) {
  if (isEcho(answer)) {
    echo_scan_ = answer.scan;
    return false;
  }
  if (latest_ && answer.scan < latest_->scan) return false;
  if (latest_ && answer.scan == latest_->scan) {
    window_.pop_back();
  } else {
    ++count_;
  }
  latest_ = answer;
  window_.push_back(answer.T_map_body);
  if (static_cast<int>(window_.size()) > rule_.count) window_.pop_front();
  return true;
}

bool ConvergenceMonitor::isStable() const {
  if (static_cast<int>(window_.size()) < rule_.count) return false;
  return std::all_of(window_.begin(), window_.end(), [this](const Transform& T) {
    return isNear(T, window_.back(), rule_.translation, rule_.rotation);
  });
}

bool ConvergenceMonitor::isSettled() const {
  switch (rule_.kind) {
    case AcceptanceRule::Kind::kFirst:
      return count_ >= 1;
    case AcceptanceRule::Kind::kNth:
      return count_ >= rule_.count;
    case AcceptanceRule::Kind::kStable:
      return isStable();
    case AcceptanceRule::Kind::kDeadline:
      break;
  }
  return false;
}

RuleReplay replayRule(const AcceptanceRule& rule, const std::vector<ScanRecord>& scans) {
  RuleReplay replay;
  ConvergenceMonitor monitor(rule, std::nullopt);
  for (const ScanRecord& record : scans) {
    if (record.is_echo || !record.position) continue;
    monitor.add({static_cast<int>(record.scan),
                 makeTransform(*record.position, *record.orientation), std::nullopt});
    replay.answer = &record;
    if (monitor.isSettled()) break;
  }
  const bool takes_last = rule.kind == AcceptanceRule::Kind::kDeadline && replay.answer != nullptr;
  replay.is_settled = takes_last || monitor.isSettled();
  return replay;
}

}  // namespace pcrb
