#pragma once

#include <array>
#include <string>
#include <vector>

#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/run/result.hpp"

namespace pcrb {

/// Statistics of one sequence and kind, or of a whole run.
struct SequenceSummary {
  /// Sequence, `data_set/sequence` where several data sets have a sequence of that name, or
  /// `total`.
  std::string name;
  std::string kind;                       ///< `local`, `global`, or `all` where kinds are pooled
  std::array<std::size_t, 5> outcomes{};  ///< number of problems per Outcome, in its order
  Statistics error;
};

/// One summary per sequence and kind, sorted by data set, sequence, kind; the total over all
/// problems (pooled, not over sequences) last.
/// @throws InvalidParameter  if an error is not finite.
std::vector<SequenceSummary> summarize(const std::vector<Result>& results);

/// The summaries as a table for a terminal and `summary.txt`: a header, a row each, aligned
/// columns, `-` where there is no value.
std::string formatSummary(const std::vector<SequenceSummary>& summaries);

/// What the replies of a localization node are worth, after an empty line: the median of doing
/// nothing, how many are worse than that or had not settled, a warning where the node makes things
/// worse. Empty where no reply says how many scans it took.
std::string describeScans(const std::vector<Result>& results);

}  // namespace pcrb
