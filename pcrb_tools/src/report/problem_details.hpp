#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/progress.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/run/problem_poser.hpp"
#include "report/scored_problem.hpp"

namespace pcrb_tools {

/// Finds in the data sets what results do not say: clouds and overlaps of imported results, and the
/// errors along each axis of stored replies.
class ProblemDetails {
 public:
  /// @param root  folder in the common layout.
  explicit ProblemDetails(std::string root);

  /// Overlaps of all pairs of clouds in the problem file of a sequence, each once; empty if there
  /// is no such file.
  std::vector<double> overlapsOf(const std::string& data_set, const std::string& sequence,
                                 pcrb::Kind kind);

  /// The least and the largest overlap that the pairs of a sequence were drawn from, as
  /// `<sequence>_overlap.txt` beside the problem file says; nothing without it.
  /// @throws pcrb::InvalidFile  if that file is malformed.
  std::optional<pcrb::Range> overlapRangeOf(const std::string& data_set,
                                            const std::string& sequence, pcrb::Kind kind) const;

  /// Adds source, target, overlap and pair to problems that have none, from the problem files.
  /// @throws pcrb::Error  if a problem file is missing or does not have a problem.
  void addPairs(Entry& entry);

  /// Adds the metric of a translation of the problem's source by 1 m.
  /// @throws pcrb::Error  if the problem file or the cloud is missing.
  void addErrorPerMetre(ScoredProblem& problem);

  /// Adds components to the answered problems of a run, and judges their covariances.
  ///
  /// @throws pcrb::Error  naming the problem, if a file is missing, or the pose error that follows
  ///                      from it is not the stored one: the data sets have changed since the run.
  void addComponents(Entry& entry, Progress& progress);

 private:
  using SequenceKey = std::pair<std::pair<std::string, std::string>, pcrb::Kind>;

  struct Sequence {
    pcrb::SequenceFiles files;
    std::map<std::string, pcrb::Problem> problems;  ///< by id; read when first asked for
  };

  Sequence& sequenceOf(const pcrb::ProblemKey& key);
  const pcrb::Problem& problemOf(const pcrb::ProblemKey& key);
  pcrb::PlannedProblem plan(const pcrb::ProblemKey& key);
  void addComponents(const pcrb::RunInfo& info, ScoredProblem& problem);

  std::string root_;
  std::map<SequenceKey, Sequence> sequences_;
  std::map<std::string, std::shared_ptr<const pcrb::Dataset>> data_sets_;
  pcrb::ProblemPoser poser_;
  std::map<std::string, double> errors_per_metre_;  ///< by path of the source
};

}  // namespace pcrb_tools
