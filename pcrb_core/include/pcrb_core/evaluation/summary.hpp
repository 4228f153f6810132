#pragma once

#include <array>
#include <string>
#include <vector>

#include "pcrb_core/evaluation/result.hpp"
#include "pcrb_core/evaluation/statistics.hpp"

namespace pcrb {

/// Statistics of one sequence and kind, or of a whole run.
struct SequenceSummary {
  std::string name;                       ///< sequence, or `total`
  std::string kind;                       ///< `local`, `global`, or `all` where kinds are pooled
  std::array<std::size_t, 5> outcomes{};  ///< number of problems per Outcome, in its order
  Statistics error;
};

/// One summary per sequence and kind, sorted, and the total over all problems last.
std::vector<SequenceSummary> summarize(const std::vector<Result>& results);

/// The summaries as a table for a terminal and `summary.txt`: a header, a row each, aligned
/// columns.
std::string formatSummary(const std::vector<SequenceSummary>& summaries);

}  // namespace pcrb
