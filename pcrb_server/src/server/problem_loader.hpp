#pragma once

#include <condition_variable>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/run/run_plan.hpp"
#include "server/serialized_cloud.hpp"
#include "server/server_parameters.hpp"

namespace pcrb {

/// One problem, ready to be served.
struct PreparedProblem : PosedProblem {
  std::shared_ptr<const PointCloud> published_source;  ///< at ground truth
  SerializedCloud source_message;
  SerializedCloud target_message;
  bool publishes_target = false;  ///< whether the target published before is another one
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

  /// ProblemPoser::checkFrames() of all problems. Call before next().
  void checkFrames() { poser_.checkFrames(problems_); }

  /// The next problem; waits until it is ready.
  /// @throws Error  if it cannot be loaded or posed.
  PreparedProblem next();

  /// Lets one more problem be prepared. The first few are without being asked; the server asks for
  /// one more whenever a reply is in, since the transport of clouds is then idle.
  void prepareAnother();

 private:
  PreparedProblem prepare(std::size_t position);
  void work();

  const ServerParameters& parameters_;
  const Secret& secret_;
  const std::vector<PlannedProblem>& problems_;
  ProblemPoser poser_;
  CloudSerializer serializer_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t allowed_;                                ///< problems that may be prepared so far
  std::deque<std::future<PreparedProblem>> prepared_;  ///< not taken yet, in order
  bool is_over_ = false;
  std::thread worker_;
};

}  // namespace pcrb
