#pragma once

#include "report/section.hpp"
#include "report/table.hpp"

namespace pcrb_tools {

/// Level below which a corrected p-value counts as a real difference.
constexpr double kSignificance = 0.05;

/// Wilcoxon's test of every two methods on the problems that both have, pairs of clouds as units
/// (their median errors), over everything and per sequence; Holm's correction within either family.
/// No rows for a single method.
Table comparisonTable(const Section& section);

/// Spearman's ρ of the error against the initial misalignment and the overlap: per sequence and
/// pooled, with all problems and without the unanswered ones, whose error is the misalignment.
Table correlationTable(const Section& section);

}  // namespace pcrb_tools
