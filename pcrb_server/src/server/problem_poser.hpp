#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "server/cloud_cache.hpp"
#include "server/run_plan.hpp"
#include "server/server_parameters.hpp"

namespace pcrb {

/// A problem with its clouds, in the target's local frame.
struct PosedProblem {
  const PlannedProblem* planned = nullptr;
  std::shared_ptr<const LoadedCloud> target;
  std::shared_ptr<const LoadedCloud> source;
  Presentation presentation;
  Transform P = Transform::Identity();  ///< perturbation in the local frame
  PoseError initial;                    ///< of P: what is scored without a reply
};

/// Loads the clouds of problems and poses them: the same for whoever serves, shows or scores them.
/// Not thread-safe.
class ProblemPoser {
 public:
  /// Both are kept by reference.
  ProblemPoser(const ServerParameters& parameters, const Secret& secret);

  /// @throws Error  naming the problem, if a cloud cannot be read or is in another frame than the
  ///                problem file.
  PosedProblem pose(const PlannedProblem& planned);

  /// Loads of each sequence and kind the source that is turned the most, and checks all its
  /// perturbations, so that clouds in another frame than the problem file's are found before the
  /// run and not in the middle of it.
  /// @throws Error  naming the sequence.
  void checkFrames(const std::vector<PlannedProblem>& problems);

 private:
  PosedProblem load(const PlannedProblem& planned);
  std::shared_ptr<LoadedCloud> loadTarget(const std::string& path);
  std::shared_ptr<LoadedCloud> loadSource(const std::string& path,
                                          const Eigen::Vector3d& local_origin);
  std::shared_ptr<LoadedCloud> makeLoaded(const std::string& path, const DatasetCloud& read,
                                          const Eigen::Vector3d& local_origin);

  const ServerParameters& parameters_;
  const Secret& secret_;
  CloudCache cache_;
  std::map<std::string, Eigen::Vector3d> origins_;  ///< as a target, by path
};

}  // namespace pcrb
