#pragma once

#include <string>
#include <vector>

#include "benchmarking/batch_tool.hpp"
#include "common/series_file.hpp"

namespace pcrb_tools {

/// Several runs of one kind: trials of the same, or one run per value of a parameter, or both.
struct SeriesOptions {
  int repeat = 1;     ///< trials
  std::string sweep;  ///< `NAME=V1,V2,…`: a parameter of the method; empty = none

  bool isOne() const { return repeat == 1 && sweep.empty(); }
};

/// The runs of a series in their order: all trials of the first value, then those of the next.
/// @throws pcrb::InvalidParameter  for a sweep without a name or values, or a value twice.
std::vector<SeriesRun> runsOfSeries(const SeriesOptions& options);

/// What a series becomes when further runs are added to it.
///
/// @param all   the series as it is.
/// @param runs  those to add; one that is there already (same parameter, value and trial) is given
///              its folder.
std::vector<SeriesRun> grown(std::vector<SeriesRun> all, std::vector<SeriesRun>& runs);

/// Text of a method's parameter file with one value replaced, whatever the data set.
///
/// @param file    the parameter file.
/// @param method  for the message.
/// @throws pcrb::InvalidParameter  if the method, where it is known here, has no such parameter.
std::string sweptParameters(const std::string& file, const std::string& method,
                            const std::string& parameter, const std::string& value);

/// Runs each run of a series as runBatchTool() does, in its folder below `options.run`: with
/// `--repeat` trial_1 …, with a sweep `NAME=VALUE`, which has the parameter file, too. What is
/// complete is kept; with `only`, of each run that shard alone.
///
/// @return  exit status: 0 only if all runs end so.
/// @throws pcrb::Error  as runBatchTool(), and if the folder holds a run; or a series, for a run.
int runSeriesTool(const BatchOptions& options, const SeriesOptions& series);

}  // namespace pcrb_tools
