#pragma once

#include <vector>

#include "report/ground_truth.hpp"
#include "report/report_tool.hpp"
#include "report/section.hpp"
#include "report/table.hpp"

namespace pcrb_tools {

/// Statistics of the error and outcomes, a row per method and selection of all levels, the medians
/// with their confidence intervals.
Table scoreTable(const Section& section, const ReportOptions& options);

/// `method,sequence,median,q75,q95,mean,stddev`: sequences and totals of all sections. A method
/// that has both kinds is called `method (kind)`.
Table summaryTable(const std::vector<Section>& sections);

/// The paper's statistics of the section's methods and sequences, as published.
Table publishedTable(const Section& section);

/// Accuracy of the ground truth: the floor below which methods cannot be told apart. No rows
/// without floors.
Table groundTruthTable(const Section& section, const std::vector<GroundTruth>& accuracies);

}  // namespace pcrb_tools
