#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "pcrb_core/run/run_plan.hpp"

namespace pcrb {

/// When a source is published: when a client has called `ready`, or at once.
enum class Handshake { kReady, kNone };

/// When the errors of problems are published: they tell a client how to do better with the same
/// clouds.
enum class ResultsTime { kEnd, kLive };

/// What is asked of a run: the same whenever it goes on, and for all its shards.
struct RunConfiguration {
  std::string under_test;  ///< name of what is benchmarked; empty = not told
  ProblemSelection selection;
  PresentationOptions presentation;
  double time_limit = 10.0;  ///< s
  Handshake handshake = Handshake::kReady;
  bool global_guess = false;  ///< whether global problems come with an initial guess
  ResultsTime results = ResultsTime::kEnd;
  bool debug = false;  ///< whether the truth was published beside the problems
};

/// The run table: what a run is, and what was noted while it went on (docs/formats.md).
///
/// Keys of the table and their texts are known here alone.
struct RunInfo {
  RunConfiguration configuration;
  std::string metric_version = "1";
  std::string code_version;
  std::map<std::string, std::string> problem_files;  ///< `<data set>/<file>` → hash
  std::map<std::string, std::string> drawn_by;       ///< of those that a tool drew: its name
  std::map<std::string, std::string> voxel_leaves;   ///< m, as text, by data set
  std::map<std::string, std::string> clouds;  ///< path below the root → hash, of those used
  std::optional<Secret> secret;
  std::optional<double> created;        ///< s since the epoch
  std::optional<std::size_t> problems;  ///< number of problems
  std::optional<std::string> client;    ///< names of its nodes, separated by blanks
  std::optional<std::string> client_parameters;
  double node_cpu_time = 0.0;          ///< s, summed over problems, 0 = unknown
  std::uint64_t node_peak_memory = 0;  ///< bytes, 0 = unknown
  std::uint64_t foreign_replies = 0;   ///< replies of nodes that were not the problem's client
  std::string merged_from;             ///< e.g. `4 shards`; empty but for a merged run
  /// Of a run that was merged of shards with a secret each, where clouds were put as it says:
  /// subject of a problem → its shard's secret.
  std::map<std::string, std::string> shard_secrets;

  std::map<std::string, std::string> others;  ///< what this version has no member for
  std::set<std::string> absent;  ///< keys that the table lacks; their members have defaults

  /// A run that is about to begin.
  static RunInfo of(const RunConfiguration& configuration, const RunPlan& plan);

  /// @param table  key → text.
  /// @param path   of the store, for messages.
  /// @throws StoreError  naming the key whose text is not what write() makes of it.
  static RunInfo read(const std::map<std::string, std::string>& table, const std::string& path);

  static RunInfo read(const ResultsStore& store) { return read(store.runInfo(), store.path()); }

  /// The table that read() reads; without keys that are absent or unknown.
  std::map<std::string, std::string> write() const;

  /// Of that what a reader of a report wants to know: no secret, no hash, nothing about the
  /// machine.
  std::map<std::string, std::string> writeShown() const;

  /// Whether the table is that of a run: all runs have a shard.
  bool isOfARun() const;

  /// Whether a secret says where clouds were put.
  bool needsSecret() const;

  /// The secret that a problem was posed with; any one where none is needed, nothing where it is
  /// not known.
  std::optional<Secret> secretOf(const ProblemKey& key) const;

  /// A key whose value differs, under the name of its parameter; without a value where there is
  /// none.
  struct Difference {
    std::string parameter;
    std::optional<std::string> here;
    std::optional<std::string> there;
  };

  /// What is compared.
  enum class Scope {
    kResume,  ///< what must be the same whenever a run goes on
    kClient,  ///< its client
    kShards   ///< what the shards of a run have in common, clouds that both have used included
  };

  /// Ordered by key.
  std::vector<Difference> differences(const RunInfo& other, Scope scope) const;

  /// Takes in what another shard of the run has noted, but for its secret.
  void merge(const RunInfo& shard);
};

}  // namespace pcrb
