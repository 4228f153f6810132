#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pcrb_core/run/run_info.hpp"
#include "pcrb_core/run/scoring.hpp"

namespace pcrb {

/// One problem as a client of the server sees it, in the target's local frame: the same bits.
struct ClientProblem {
  std::string id;  ///< official one
  std::string data_set;
  std::string sequence;
  Kind kind = Kind::kLocal;
  std::vector<float> target;  ///< x y z of each point, m
  std::vector<float> source;  ///< x y z of each point, m, in its sensor's frame for localization
  std::vector<float> target_intensity;  ///< empty where there is none
  std::vector<float> source_intensity;
  Transform guess = Transform::Identity();  ///< T_target_source to start from
  bool has_guess = false;                   ///< else the guess is the identity and means nothing
  double voxel_leaf = 0.0;                  ///< m, of the data set
};

/// What is asked of a run in this process.
struct InProcessRunOptions {
  RunConfiguration configuration;
  std::string run;     ///< folder of the results; empty = nothing is kept
  std::string client;  ///< noted as the run's client
};

/// A run without ROS, whose client is called in this process: the same problems in the same
/// presentation, the same score of the same pose, the same store. A run that is kept has a secret
/// order, as the server's, and goes on where it was; else problems come in the order of their
/// files. Not thread-safe.
class InProcessRun {
 public:
  /// @throws Error  as benchmark_server: unknown sequence, malformed files, another run's folder.
  explicit InProcessRun(const InProcessRunOptions& options);
  ~InProcessRun();
  InProcessRun(const InProcessRun&) = delete;
  InProcessRun& operator=(const InProcessRun&) = delete;

  std::size_t size() const;  ///< problems, those that have a result included
  std::size_t done() const;  ///< problems that have a result

  /// The next problem without a result; nothing after the last one.
  std::optional<ClientProblem> next();

  /// Scores an answer to the problem of next(), and keeps nothing.
  ///
  /// @param runtime  s, from the problem to its answer; beyond the time limit it counts as none.
  /// @throws InvalidParameter  without a problem.
  Result score(const Submission& submission, double runtime) const;

  /// Scores and keeps the answer to the problem of next(), which ends with it.
  Result submit(const Submission& submission, double runtime);

  /// Writes results.csv and summary.txt of a run that is kept.
  /// @return  the summary's text.
  std::string finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pcrb
