#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/evaluation/covariance_consistency.hpp"
#include "pcrb_core/run/result.hpp"
#include "pcrb_core/run/run_info.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb_tools {

/// What the initial guess of a problem leaves.
struct Untouched {
  double rotation_error = 0.0;            ///< rad
  double translation_error = 0.0;         ///< m, of the source's centroid
  std::array<double, 6> components = {};  ///< x y z (m) roll pitch yaw (rad)
};

/// One problem and how a method did on it. What a source of results does not say is empty.
struct ScoredProblem {
  pcrb::ProblemKey key;
  std::string source;
  std::string target;
  int trial = 0;     ///< of a run that was repeated: from 1
  std::string pair;  ///< names the pair of clouds within the kind: the unit of all tests
  std::optional<double> overlap;
  pcrb::Outcome outcome = pcrb::Outcome::kReplied;
  std::string reason;
  double error = 0.0;
  std::optional<double> initial_misalignment;
  std::optional<double> rotation_error;     ///< rad
  std::optional<double> translation_error;  ///< m
  std::optional<double> runtime;            ///< s
  std::optional<double> solver_time;        ///< s
  bool target_changed = false;
  std::optional<double> finished;                   ///< s since the epoch
  std::optional<pcrb::Transform> reply;             ///< the accepted pose, as it was sent
  std::optional<std::array<double, 6>> components;  ///< x y z (m) roll pitch yaw (rad)
  std::optional<Untouched> untouched;               ///< where clouds were read
  std::vector<pcrb::ScanRecord> scans;              ///< of a localization node
  std::optional<pcrb::PoseCovariance> covariance;   ///< of that pose
  std::optional<pcrb::JudgedCovariance> judged;     ///< where it could be judged
  std::optional<double> error_per_metre;  ///< the metric of a translation of 1 m of this source

  bool isAnswered() const { return outcome == pcrb::Outcome::kReplied; }
};

/// The problems of one kind that one method was given.
struct Entry {
  std::string method;
  pcrb::Kind kind = pcrb::Kind::kLocal;
  std::string path;                          ///< run folder or file
  std::optional<pcrb::RunInfo> info;         ///< of a run; imports have none
  int trials = 1;                            ///< of which the problems are, each of every trial
  std::string series;                        ///< of a run of a sweep: what all its runs are called
  std::string parameter;                     ///< that is swept; empty = none
  std::string value;                         ///< of that parameter
  std::map<int, std::string> trial_folders;  ///< of a series: each trial's run
  std::vector<ScoredProblem> problems;       ///< ordered by key and trial
};

/// Names the pair of clouds: by its clouds where they are known, by the official id where it is one
/// (31 problems belong to a pair), else every problem is a pair of its own.
std::string pairOf(const ScoredProblem& problem);

/// Whether an id is one that the published problem files can have: their lists have so many pairs
/// that the index has four digits.
bool hasPublishedId(const pcrb::ProblemKey& key);

}  // namespace pcrb_tools
