#pragma once

#include <string>
#include <vector>

#include "benchmarking/batch_tool.hpp"

namespace pcrb_tools {

/// The number of shards of a batch: as asked for, else as noted in its folder, else as many as
/// jobs.
/// @throws pcrb::Error  if the note in the folder is of something else.
int numberOfShards(const BatchOptions& options);

/// Notes in `<run>/batch.txt` what is run, if nothing is noted there, so that no other program can
/// go on with it.
/// @throws pcrb::Error  if something else is noted, naming every difference.
void noteConfiguration(const BatchOptions& options, int shards);

/// roslaunch itself takes an argument that no launch file declares for none, without a word.
/// @throws pcrb::InvalidParameter  if there is such an argument, naming those that are known.
void requireKnownArguments(const BatchOptions& options);

/// roslaunch and its arguments, but for `run` and `shard`.
/// @throws pcrb::InvalidParameter  if those or a wrong `root` are among the arguments.
std::vector<std::string> launchCommand(const BatchOptions& options);

}  // namespace pcrb_tools
