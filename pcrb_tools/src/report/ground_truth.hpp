#pragma once

#include <string>
#include <vector>

namespace pcrb_tools {

/// Accuracy of one sequence's ground truth, as evaluate_ground_truth finds it.
struct GroundTruth {
  std::string data_set;
  std::string sequence;
  double mean = 0.0;    ///< m
  double stddev = 0.0;  ///< m
};

/// Reads the CSV file of evaluate_ground_truth: a header with at least `data_set`, `sequence`,
/// `mean` and `stddev`. A sequence where both are empty is left out: no pair could be aligned.
/// @throws pcrb::InvalidFile  with file and line, what was found and what was expected.
std::vector<GroundTruth> readGroundTruth(const std::string& path);

}  // namespace pcrb_tools
