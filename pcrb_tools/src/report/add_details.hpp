#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/ground_truth.hpp"
#include "report/problem_details.hpp"
#include "report/report_tool.hpp"

namespace pcrb_tools {

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

}  // namespace pcrb_tools
