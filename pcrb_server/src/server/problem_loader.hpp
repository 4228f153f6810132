#pragma once

#include <condition_variable>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "server/cloud_cache.hpp"
#include "server/run_plan.hpp"
#include "server/serialized_cloud.hpp"
#include "server/server_parameters.hpp"

namespace pcrb {

/// One problem, ready to be served.
struct PreparedProblem {
  const PlannedProblem* planned = nullptr;
  std::shared_ptr<const LoadedCloud> target;
  std::shared_ptr<const LoadedCloud> source;
  SerializedCloud source_message;
  SerializedCloud target_message;
  bool publishes_target = false;  ///< whether the target published before is another one
  Presentation presentation;
  Transform P = Transform::Identity();  ///< perturbation in the local frame
  PoseError initial;                    ///< of P: what is scored without a reply
};

/// Loads and prepares problems ahead of the server, in a thread of its own.
class ProblemLoader {
 public:
  /// @param problems  in serving order; kept by reference, as are the others.
  ProblemLoader(const ServerParameters& parameters, const Secret& secret,
                const std::vector<PlannedProblem>& problems);
  ~ProblemLoader();
  ProblemLoader(const ProblemLoader&) = delete;
  ProblemLoader& operator=(const ProblemLoader&) = delete;

  /// Loads of each sequence and kind the source that is turned the most, and checks all its
  /// perturbations, so that clouds in another frame than the problem file's are found before the
  /// run and not in the middle of it. Call before next().
  /// @throws Error  naming the sequence.
  void checkFrames();

  /// The next problem; waits until it is ready.
  /// @throws Error  if it cannot be loaded or posed.
  PreparedProblem next();

  /// Lets one more problem be prepared. The first few are without being asked; the server asks for
  /// one more whenever a reply is in, since the transport of clouds is then idle.
  void prepareAnother();

 private:
  PreparedProblem prepare(std::size_t position);
  void checkFramesOfSource(const PreparedProblem& loaded);
  void pose(PreparedProblem& prepared, const std::string& previous_target);
  std::shared_ptr<LoadedCloud> loadTarget(const std::string& path);
  std::shared_ptr<LoadedCloud> loadSource(const std::string& path,
                                          const Eigen::Vector3d& local_origin);
  std::shared_ptr<LoadedCloud> makeLoaded(const std::string& path, const DatasetCloud& read,
                                          const Eigen::Vector3d& local_origin);
  void work();

  const ServerParameters& parameters_;
  const Secret& secret_;
  const std::vector<PlannedProblem>& problems_;
  CloudCache cache_;
  std::map<std::string, Eigen::Vector3d> origins_;  ///< local origins of targets, by path
  CloudSerializer serializer_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t allowed_;                                ///< problems that may be prepared so far
  std::deque<std::future<PreparedProblem>> prepared_;  ///< not taken yet, in order
  bool is_over_ = false;
  std::thread worker_;
};

}  // namespace pcrb
