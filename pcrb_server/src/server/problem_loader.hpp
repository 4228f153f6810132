#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <boost/make_shared.hpp>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "server/cloud_cache.hpp"
#include "server/run_plan.hpp"
#include "server/server_parameters.hpp"

namespace pcrb {

/// One problem, ready to be served.
struct PreparedProblem {
  const PlannedProblem* planned = nullptr;
  std::shared_ptr<const LoadedCloud> target;
  std::shared_ptr<const LoadedCloud> source;
  sensor_msgs::PointCloud2Ptr source_message;  ///< header to be filled in when it is published
  sensor_msgs::PointCloud2Ptr target_message;  ///< empty where the target has not changed
  Presentation presentation;
  Transform P = Transform::Identity();  ///< perturbation in the local frame
};

/// Loads and prepares problems one ahead of the server, in the background.
class ProblemLoader {
 public:
  /// @param problems  in serving order; kept by reference, as is `secret`.
  ProblemLoader(const ServerParameters& parameters, const Secret& secret,
                const std::vector<PlannedProblem>& problems);
  ~ProblemLoader();

  /// Loads the first source of each sequence and kind, so that clouds in another frame than the
  /// problem file's are found before the run and not in the middle of it. Call before next().
  /// @throws Error  naming the sequence.
  void checkFrames();

  /// The next problem; waits until it is ready and starts to prepare the one after it.
  /// @throws Error  if it cannot be loaded or posed.
  PreparedProblem next();

 private:
  PreparedProblem prepare(std::size_t position);
  void pose(PreparedProblem& prepared, const std::string& previous_target);
  std::shared_ptr<LoadedCloud> loadTarget(const std::string& path);
  std::shared_ptr<LoadedCloud> loadSource(const std::string& path,
                                          const Eigen::Vector3d& local_origin);
  std::shared_ptr<LoadedCloud> makeLoaded(const std::string& path, const DatasetCloud& read,
                                          const Eigen::Vector3d& local_origin);
  void prefetch();

  const ServerParameters& parameters_;
  const Secret& secret_;
  const std::vector<PlannedProblem>& problems_;
  std::size_t position_ = 0;
  CloudCache cache_;
  std::map<std::string, Eigen::Vector3d> origins_;  ///< local origins of targets, by path
  std::future<PreparedProblem> next_;
};

}  // namespace pcrb
