#pragma once

#include <string>
#include <vector>

#include "pcrb_core/run/result.hpp"

namespace pcrb {

/// What `merge_runs` is asked for.
struct MergeOptions {
  std::vector<std::string> runs;  ///< folders of finished runs, the shards 0/N … (N − 1)/N of one
  std::string output;             ///< folder of the merged run; what a merge left there is replaced
};

/// What a merge gives.
struct MergeReport {
  std::string summary;  ///< as in summary.txt
  std::string defects;  ///< a line for each shard whose node under test never answered
};

/// What is wrong with a shard in which no result is an answer of the node under test; nothing
/// otherwise.
std::string describeSilence(const std::vector<Result>& results);

/// Puts the shards of a run together: a run folder like that of a run without shards, with results,
/// sessions and exports. The shards are only read.
///
/// @throws Error  and writes nothing, if the shards are not all parts of one run (every
///                      difference in their configuration is named: parameters, problem files,
///                      clouds, client, version), one is missing or there twice, one has problems
///                      without a result, two share a problem, or the output is a run that no merge
///                      made.
MergeReport mergeRuns(const MergeOptions& options);

}  // namespace pcrb
