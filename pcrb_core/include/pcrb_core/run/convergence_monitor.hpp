#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "pcrb_core/pose_covariance.hpp"
#include "pcrb_core/run/result.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// A localization node's answer to one scan.
struct ScanAnswer {
  int scan = 0;  ///< which scan of the problem, from 1
  Transform T_map_body = Transform::Identity();
  std::optional<PoseCovariance> covariance;  ///< of T_map_body
};

/// Which of a node's answers is submitted.
struct AcceptanceRule {
  enum class Kind {
    kFirst,    ///< the first answer
    kNth,      ///< the answer number `count`
    kStable,   ///< `count` answers in a row that differ less than the tolerances
    kDeadline  ///< the last answer when the time is nearly over
  };

  Kind kind = Kind::kStable;
  int count = 3;
  double translation = 0.01;     ///< m, tolerance of kStable
  double rotation = 0.002;       ///< rad, tolerance of kStable
  double echo_tolerance = 1e-4;  ///< m and rad: a first answer so near the initial pose is an echo
};

/// Follows a node's answers to one problem until they settle.
///
/// Many nodes publish the initial pose itself as their first answer: if the first answer is that,
/// it does not count. Answers come in the order of their scans; another one to a scan replaces the
/// one before it, an older one is dropped.
class ConvergenceMonitor {
 public:
  ConvergenceMonitor(const AcceptanceRule& rule, const std::optional<Transform>& initial_pose);

  /// @return  whether the answer counts.
  bool add(const ScanAnswer& answer);

  bool isSettled() const;

  /// The newest answer that counts.
  const std::optional<ScanAnswer>& latest() const { return latest_; }

  /// Scans that were answered, an echo excepted.
  int count() const { return count_; }

  bool hasEchoed() const { return echo_scan_ > 0; }

 private:
  bool isEcho(const ScanAnswer& answer) const;
  bool isStable() const;

  AcceptanceRule rule_;
  std::optional<Transform> initial_pose_;
  int echo_scan_ = 0;  ///< the scan that was answered by an echo, 0 = none
  int count_ = 0;
  std::optional<ScanAnswer> latest_;
  std::deque<Transform> window_;  ///< the last `count` answers
};

/// Which of a problem's stored answers a rule would have taken.
struct RuleReplay {
  const ScanRecord* answer = nullptr;  ///< none where no answer counts
  bool is_settled = false;             ///< false: the last answer, for want of a better one
};

/// @param scans  of one problem, in order; must outlive what is returned.
RuleReplay replayRule(const AcceptanceRule& rule, const std::vector<ScanRecord>& scans);

/// Whether two poses differ by less than m and rad.
bool isNear(const Transform& a, const Transform& b, double translation, double rotation);

}  // namespace pcrb
