#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/run/cloud_cache.hpp"
#include "pcrb_core/run/run_plan.hpp"

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

/// How a problem with its clouds is put to a client; what `presentation` is does not count.
Presentation present(const PosedProblem& posed, const PresentationOptions& options,
                     const Secret& secret);

/// The points that an audit publishes of the target, and of the source: a secret part in a secret
/// order, of the source another one for each problem.
PointCloud auditedTarget(const PosedProblem& posed, const Secret& secret);
PointCloud auditedSource(const PosedProblem& posed, const Secret& secret);

/// How clouds are loaded.
struct LoadOptions {
  std::size_t cache_bytes = std::size_t{512} << 20;  ///< kept at most, one pair of clouds at least
  int threads = 1;                                   ///< of the reader of ASCII files
};

/// Loads the clouds of problems and poses them: the same for the server, the replay, the offline
/// scoring and the report. Not thread-safe.
class ProblemPoser {
 public:
  /// @param root    folder below which the clouds lie; their names are relative to it.
  /// @param secret  of localization's sensor poses.
  ProblemPoser(std::string root, const PresentationOptions& presentation, const Secret& secret,
               const LoadOptions& loading = {});

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

  std::string root_;
  PresentationOptions presentation_;
  Secret secret_;
  int threads_;
  CloudCache cache_;
  std::map<std::string, Eigen::Vector3d> origins_;  ///< as a target, by path
};

}  // namespace pcrb
