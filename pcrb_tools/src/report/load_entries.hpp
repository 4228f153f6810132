#pragma once

#include <string>
#include <vector>

#include "report/report_tool.hpp"
#include "report/scored_problem.hpp"

namespace pcrb_tools {

/// Reads all runs and imports, one entry per method and kind, in the order in which they are given.
/// A run is called NAME (`NAME=FOLDER`) or after its folder; an import after its file.
///
/// @throws pcrb::Error  if one cannot be read, has no result, or has the name of another one.
std::vector<Entry> loadEntries(const ReportOptions& options);

}  // namespace pcrb_tools
