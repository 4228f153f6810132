#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/log_plan.hpp"

namespace pcrb_tools::simulation {

/// What make_sample_logs is asked for.
struct SampleLogsRequest {
  std::string output;
  std::uint64_t seed = 1;
  std::string size = "small";       ///< small, medium or large
  double ground_truth_error = 0.0;  ///< m, >= 0
  std::vector<std::string> data_sets = {"eth", "planetary", "tum", "kaist"};
  int threads = 1;
};

/// The counts of a named size.
/// @throws InvalidParameter  if the name is not small, medium or large.
LogSize logSize(const std::string& name);

/// Simulates the logs of the data sets, each below `<output>/<data set>/` as its archives unpack.
///
/// The same seed, size and error give the same bytes at any number of threads. Files that an
/// earlier, interrupted call with the same settings left are kept; `<output>/sample_logs.txt`
/// remembers the settings, `<output>/ground_truth_error.csv` what was added to the ground truth.
/// @throws InvalidParameter  if a parameter is out of range, or the folder has other contents.
/// @throws InvalidFile       if a file cannot be written; what is complete stays.
void makeSampleLogs(const SampleLogsRequest& request);

}  // namespace pcrb_tools::simulation
