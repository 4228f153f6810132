#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// What a localization node said about one scan.
struct PoseAnswer {
  int scan = 0;  ///< which scan of the problem, from 1
  Transform T_map_body = Transform::Identity();
  std::optional<std::array<double, 36>> covariance;  ///< of T_map_body, row-major x y z rx ry rz
};

/// When a node's answers are taken for its last word.
struct SettlingRule {
  enum class Kind {
    kFirst,    ///< the first answer
    kNth,      ///< the answer number `count`
    kStable,   ///< `count` answers in a row that differ less than the tolerances
    kDeadline  ///< whatever was said last when the time is nearly over
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
class Settling {
 public:
  Settling(const SettlingRule& rule, const std::optional<Transform>& initial_pose);

  /// @return  whether the answer counts.
  bool add(const PoseAnswer& answer);

  bool isSettled() const;

  /// The newest answer that counts.
  const std::optional<PoseAnswer>& latest() const { return latest_; }

  /// Scans that were answered, an echo excepted.
  int count() const { return count_; }

  bool hasEchoed() const { return echo_scan_ > 0; }

 private:
  bool isEcho(const PoseAnswer& answer) const;
  bool isStable() const;

  SettlingRule rule_;
  std::optional<Transform> initial_pose_;
  int echo_scan_ = 0;  ///< the scan that was answered by an echo, 0 = none
  int count_ = 0;
  std::optional<PoseAnswer> latest_;
  std::deque<Transform> window_;  ///< the last `count` answers
};

/// Whether two poses differ by less than m and rad.
bool isNear(const Transform& a, const Transform& b, double translation, double rotation);

}  // namespace pcrb
