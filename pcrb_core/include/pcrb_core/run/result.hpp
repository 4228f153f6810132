#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/problem/problem.hpp"

namespace pcrb {

/// How a problem ended; all but kReplied are scored with the initial guess.
enum class Outcome { kReplied, kFailed, kTimedOut, kRejected, kSkipped };

/// `replied`, `failed`, `timed_out`, `rejected` or `skipped`.
const char* toString(Outcome outcome);

/// @throws InvalidParameter  if the text names no outcome.
Outcome outcomeFromString(const std::string& text);

/// Which problem a result belongs to, by its official id: unique within a run.
struct ProblemKey {
  std::string data_set;
  std::string sequence;
  Kind kind = Kind::kLocal;
  std::string problem_id;

  /// `data_set/sequence kind problem_id`. Secrets are derived from this text (docs/formats.md):
  /// other bytes would give other scores and another order to runs that go on.
  std::string subject() const;

  bool operator<(const ProblemKey& other) const;
  bool operator==(const ProblemKey& other) const;
};

/// A scan that a localization node was given for a problem, and its newest answer to it. Times are
/// s since the first scan was due.
struct ScanRecord {
  std::uint32_t scan = 0;  ///< from 1
  double sent = 0.0;
  std::optional<double> answered;
  bool is_echo = false;                     ///< whether the answer only repeats the initial pose
  std::optional<Eigen::Vector3d> position;  ///< m, of the answer, in the target's frame
  std::optional<Eigen::Quaterniond> orientation;  ///< unit
  std::optional<double> error;                    ///< of the answer
};

/// One row of the results store (docs/formats.md). Unknown is an empty optional, stored as NULL.
struct Result {
  ProblemKey key;
  std::string source;
  std::string target;
  double overlap = 0.0;
  Outcome outcome = Outcome::kReplied;
  std::string reason;  ///< a client's words; the store keeps their printableText()
  double error = 0.0;
  double initial_misalignment = 0.0;
  double rotation_error = 0.0;        ///< rad
  double translation_error = 0.0;     ///< m
  std::optional<double> runtime;      ///< s, from the source's publication to the reply
  std::optional<double> solver_time;  ///< s, as the client says
  std::optional<std::uint32_t> scans_used;
  bool target_changed = false;  ///< whether the problem before, in serving order, has another one
  std::uint32_t replies_rejected = 0;
  std::optional<Eigen::Vector3d> position;        ///< m, the accepted reply, in the target's frame
  std::optional<Eigen::Quaterniond> orientation;  ///< unit
  std::optional<std::array<double, 36>> covariance;  ///< row-major x y z rx ry rz
  double finished = 0.0;                             ///< s since the epoch
  std::vector<ScanRecord> scans;  ///< of a localization node; ResultsStore::scans() reads them
};

/// Reason of a problem that localization_bridge, not the node under test, gave up as kFailed.
inline constexpr const char* kNodeLeft = "the node under test left while it had the problem";

/// Beginning of the reason of a reply that localization_bridge took from a node whose answers had
/// not settled.
inline constexpr const char* kNotSettled = "not settled";

/// Whether the node under test itself said something that could be taken: a valid reply, or that it
/// cannot.
bool isAnswered(const Result& result);

}  // namespace pcrb
