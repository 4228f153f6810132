#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "pcrb_core/run/run_info.hpp"
#include "pcrb_core/run/run_plan.hpp"

namespace pcrb {

/// A run folder: opens or resumes it, keeps its results, and writes its exports at the end.
class RunRecord {
 public:
  /// A run without a result takes any configuration, and keeps its secret.
  ///
  /// @param folder  of the run; made where it is missing.
  /// @param secret  that a new run gets and an old one must have; nothing = a new run draws one.
  /// @throws StoreError  if the folder holds results of another configuration (naming every
  ///                     difference), of other problem files, or cannot be used.
  RunRecord(const std::string& folder, const RunConfiguration& configuration, const RunPlan& plan,
            const std::optional<Secret>& secret = std::nullopt);
  ~RunRecord();
  RunRecord(const RunRecord&) = delete;
  RunRecord& operator=(const RunRecord&) = delete;

  const Secret& secret() const { return secret_; }

  /// What a problem is called while this session lasts: a reply that was meant for an earlier one,
  /// which a kill ended, is to an unknown problem.
  std::string publicId(const PlannedProblem& planned) const;

  std::set<ProblemKey> finished() const { return store_.finished(); }

  /// Records the hash of a cloud that is about to be served.
  /// @throws StoreError  if the run has used other content under that name.
  void noteCloud(const std::string& name, const std::string& hash);

  /// Records who answers, and how it is set up: shards with other ones cannot be merged.
  ///
  /// A run goes on only with the client that its results are from: the same parameters and, unless
  /// `under_test` tells what is benchmarked or there is no handshake, the same name. Where another
  /// name is taken, both are recorded.
  /// @param name        of the client's node; of several, separated by blanks.
  /// @param parameters  the client's private parameters as text; empty = none.
  /// @throws StoreError  if the run has results of another client.
  void noteClient(const std::string& name, const std::string& parameters);

  /// Names of those who answered, as far as it is recorded.
  std::set<std::string> clients() const;

  /// Adds to what the node under test has used in this run, as far as its client knows.
  /// @param cpu_time     s, for one more problem; 0 = unknown.
  /// @param peak_memory  bytes, so far; 0 = unknown.
  void noteUsage(double cpu_time, std::uint64_t peak_memory);

  /// Counts replies of nodes that were not the client of the problem.
  void noteForeignReplies(std::uint64_t count);

  /// Commits a result: it is on the disk when this returns.
  void add(const Result& result) { store_.add(result); }

  /// All results so far, read from the store.
  std::vector<Result> results() const { return store_.results(); }

  /// Writes results.csv and summary.txt.
  void writeExports(const std::string& summary_text);

 private:
  const Secret& begin(const RunConfiguration& configuration, const RunPlan& plan,
                      const std::optional<Secret>& secret);
  const Secret& resume(const RunConfiguration& configuration, const RunPlan& plan,
                       const std::optional<Secret>& secret);
  void save();

  std::string folder_;
  ResultsStore store_;
  RunInfo info_;
  std::map<std::string, std::string> saved_;  ///< the run table as it is in the store
  Secret secret_;
  std::string session_;  ///< its number, from 1
};

}  // namespace pcrb
