#pragma once

#include "report/section.hpp"
#include "report/table.hpp"

namespace pcrb_tools {

/// Numbers that are drawn and are in no table: `thresholds` and `solved` (fraction of problems
/// solved over the error threshold, per method), `over_misalignment` and `over_overlap` (quartiles
/// of the error in bins, per data set and method), `histograms` (of the error, per sequence and
/// method, with median, mean and standard deviation) and `overlaps` (of the pairs, per sequence).
Json chartsOf(const Section& section);

}  // namespace pcrb_tools
