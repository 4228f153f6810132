#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/problem_details.hpp"
#include "report/report_tool.hpp"
#include "report/section.hpp"
#include "report/table.hpp"

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

/// Data sets by their root folder.
using DetailsByRoot = std::map<std::string, ProblemDetails>;

/// Adds to results what their data sets say, where these are there: clouds and overlaps, the errors
/// along each axis unless they are not wanted, and what a floor is made of, of each sequence whose
/// ground truth has a known accuracy. Standard error has a line for what has no floor.
///
/// @throws pcrb::Error  if a file of the data sets is missing or defective, they have changed since
///                      the run, or no accuracy belongs to any result.
DetailsByRoot addDetails(const ReportOptions& options, const std::vector<GroundTruth>& accuracies,
                         std::vector<Entry>& entries);

/// Accuracy of the ground truth: the floor below which methods cannot be told apart. No rows
/// without floors.
Table groundTruthTable(const Section& section, const std::vector<GroundTruth>& accuracies);

}  // namespace pcrb_tools
