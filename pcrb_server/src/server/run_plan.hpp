#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pcrb_core/evaluation/result.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/transform.hpp"
#include "server/server_parameters.hpp"

namespace pcrb {

/// One problem of a run, with all that is known before its clouds are loaded.
struct PlannedProblem {
  ProblemKey key;
  Problem problem;
  Transform P = Transform::Identity();  ///< perturbation in the data set's frame
  std::shared_ptr<const Dataset> data_set;
  std::string source_path;
  std::string target_path;
  bool target_changed = true;  ///< whether the problem served before has another target

  /// Names the problem where secrets are derived: unique within a run, never published.
  std::string subject() const;
};

/// The problems that the parameters select, and the hashes of the files that they came from.
struct RunPlan {
  std::vector<PlannedProblem> problems;              ///< in the order of the problem files
  std::map<std::string, std::string> problem_files;  ///< `<data set>/<file>` → hash
  std::map<std::string, std::string> drawn_by;       ///< of those that a tool drew: its name
};

/// Reads the selected problem files; draws the subset and the shard.
///
/// @throws Error  for an unknown sequence (naming the known ones), a malformed file, a perturbation
/// that
///                is not rigid, a missing cloud, or nothing selected.
RunPlan makeRunPlan(const ServerParameters& parameters);

/// The problems in the secret order in which they are served, their target_changed set.
std::vector<PlannedProblem> inServingOrder(const std::vector<PlannedProblem>& problems,
                                           const Secret& secret);

}  // namespace pcrb
