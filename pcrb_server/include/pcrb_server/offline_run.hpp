#pragma once

#include <pcrb_msgs/SubmitPose.h>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb {

/// A run whose replies are there already.
struct OfflineRunOptions {
  std::string root;
  std::string sequence;  ///< `data_set/sequence`
  Kind kind = Kind::kLocal;
  PresentationKind presentation = PresentationKind::kRegistration;
  bool upright = false;
  std::string secret;  ///< 32 hexadecimal digits; of localization's sensor poses
  int subset = 0;      ///< 0 = all problems
  int seed = 1;
  std::string run;                ///< folder of the results
  std::string client;             ///< noted as the run's client
  bool in_dataset_frame = false;  ///< whether replies are in the clouds' frame, not the map's
};

/// A reply, as a client would have sent it.
struct OfflineReply {
  pcrb_msgs::SubmitPose::Request request;  ///< its id and frame do not count
  std::string defect;  ///< why there is no pose that a request could hold; empty where there is
};

/// Scores poses into the store that the server would have filled: the same pose of the same problem
/// gets the same bits.
class OfflineRun {
 public:
  /// Opens or resumes the run.
  /// @throws Error  as benchmark_server: unknown sequence, malformed files, another run's folder.
  explicit OfflineRun(const OfflineRunOptions& options);
  ~OfflineRun();
  OfflineRun(const OfflineRun&) = delete;
  OfflineRun& operator=(const OfflineRun&) = delete;

  std::size_t size() const;  ///< number of problems

  /// Stores the result of every problem that has none yet, and writes the exports.
  ///
  /// A problem without a reply counts as timed out, one whose reply the server would not take as
  /// rejected; both are scored with their initial guess.
  /// @param replies  by official id.
  /// @param on_row   called for each problem that has its result.
  /// @return         the summary's text.
  std::string score(const std::map<std::string, OfflineReply>& replies,
                    const std::function<void()>& on_row);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pcrb
