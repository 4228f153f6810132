#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/progress.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "report/scored_problem.hpp"

namespace pcrb_tools {

/// Finds in the data sets what results do not say: clouds and overlaps of imported results, and the
/// errors along each axis of stored replies. Every cloud is read once and only what is needed of it
/// is kept.
class ProblemDetails {
 public:
  /// @param root  folder in the common layout.
  explicit ProblemDetails(std::string root);

  /// Overlaps of all pairs of clouds in the problem file of a sequence, each once; empty if there
  /// is no such file.
  std::vector<double> overlapsOf(const std::string& data_set, const std::string& sequence,
                                 pcrb::Kind kind);

  /// Adds source, target, overlap and pair to problems that have none, from the problem files.
  /// @throws pcrb::Error  if a problem file is missing or does not have a problem.
  void addPairs(Entry& entry);

  /// Adds the metric of a translation of the problem's source by 1 m.
  /// @throws pcrb::Error  if the problem file or the cloud is missing.
  void addErrorPerMetre(ScoredProblem& problem);

  /// Adds components to the answered problems of a run.
  ///
  /// @throws pcrb::Error  naming the problem, if a file is missing, or the pose error that follows
  ///                      from it is not the stored one: the data sets have changed since the run.
  void addComponents(Entry& entry, Progress& progress);

 private:
  struct Cloud {
    Eigen::Vector3d origin;    ///< local origin that it has as a target, data set frame
    Eigen::Vector3d centroid;  ///< data set frame
    bool has_viewpoint = false;
    pcrb::Transform viewpoint = pcrb::Transform::Identity();  ///< T_dataset_sensor
    double error_per_metre = 0.0;
  };
  using SequenceKey = std::pair<std::pair<std::string, std::string>, pcrb::Kind>;

  struct Sequence {
    pcrb::SequenceFiles files;
    std::map<std::string, pcrb::Problem> problems;  ///< by id; read when first asked for
  };

  Sequence& sequenceOf(const pcrb::ProblemKey& key);
  const pcrb::Problem& problemOf(const pcrb::ProblemKey& key);
  const Cloud& cloud(const std::string& path);
  void addComponents(const Entry& entry, ScoredProblem& problem);

  std::string root_;
  std::map<SequenceKey, Sequence> sequences_;
  std::map<std::string, Cloud> clouds_;  ///< by path
};

}  // namespace pcrb_tools
