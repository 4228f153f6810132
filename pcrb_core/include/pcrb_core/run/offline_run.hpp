#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/run/run_info.hpp"
#include "pcrb_core/run/scoring.hpp"

namespace pcrb {

/// Frame that the poses of an offline run are in.
enum class PoseFrame {
  kMap,     ///< that of the target's local origin, which a client sees
  kDataset  ///< that of the clouds' files
};

/// A run whose replies are there already.
struct OfflineRunOptions {
  std::string run;  ///< folder of the results
  RunConfiguration configuration;
  std::optional<Secret> secret;  ///< of localization's sensor poses; nothing = a new one
  std::string client;            ///< noted as the run's client
  PoseFrame pose_frame = PoseFrame::kMap;
};

/// A reply, as a client would have sent it.
struct OfflineReply {
  Submission submission;
  std::string defect;  ///< why there is no pose that could be submitted; empty where there is
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
