#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/run/result.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// One of `count` disjoint parts of the problems, for several machines; `0/1` is all of them.
struct ShardNumber {
  std::size_t index = 0;
  std::size_t count = 1;
};

/// `i/N`.
std::string toString(const ShardNumber& shard);

/// @throws InvalidParameter  unless the text is i/N with 0 <= i < N <= 1000000.
ShardNumber shardFromString(const std::string& text);

/// Which problems a run consists of.
struct ProblemSelection {
  std::string root;                           ///< folder in the common layout (docs/formats.md)
  std::vector<std::string> sequences{"all"};  ///< words of namesSequence()
  std::vector<Kind> kinds{Kind::kLocal};
  std::size_t subset = 0;  ///< number of problems drawn, 0 = all
  std::uint64_t seed = 1;  ///< of that draw
  ShardNumber shard;       ///< the part of the subset
};

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
  std::string subject() const { return key.subject(); }
};

/// The problems that a selection names, and the hashes of the files that they came from.
struct RunPlan {
  std::vector<PlannedProblem> problems;              ///< in the order of the problem files
  std::map<std::string, std::string> problem_files;  ///< `<data set>/<file>` → hash
  std::map<std::string, std::string> drawn_by;       ///< of those that a tool drew: its name
  std::map<std::string, std::string> voxel_leaves;   ///< m, as text, by data set
};

/// Reads the selected problem files; draws the subset and the shard.
///
/// @throws Error  for a word that names no sequence (naming the known ones), a malformed file, a
///                perturbation that is not rigid, a missing cloud, or nothing selected.
RunPlan makeRunPlan(const ProblemSelection& selection);

/// One row of a problem file, planned.
///
/// @param line  of the row, for messages; 0 = not known.
/// @throws InvalidFile  if a cloud is missing, or the perturbation is not rigid.
PlannedProblem planProblem(const SequenceFiles& files, const Problem& problem, std::size_t line,
                           std::shared_ptr<const Dataset> data_set);

/// The problems by their keys.
std::map<ProblemKey, PlannedProblem> problemsByKey(const RunPlan& plan);

/// The problems in the secret order in which they are served, their target_changed set.
std::vector<PlannedProblem> inServingOrder(const std::vector<PlannedProblem>& problems,
                                           const Secret& secret);

}  // namespace pcrb
