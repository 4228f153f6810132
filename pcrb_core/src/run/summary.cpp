#include "pcrb_core/run/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

using Group = std::tuple<std::string, std::string, Kind>;  // data set, sequence, kind
using Row = TableRow;

/// What is gathered about one group of problems before its statistics are computed.
struct Tally {
  std::array<std::size_t, 5> outcomes{};
  std::vector<double> errors;

  void add(const Result& result) {
    ++outcomes.at(static_cast<std::size_t>(result.outcome));
    errors.push_back(result.error);
  }

  SequenceSummary summary(const std::string& name, const std::string& kind) const {
    return {name, kind, outcomes, describe(errors)};
  }
};

std::string formatError(double value) {
  if (std::isnan(value)) return "-";
  constexpr double kLargestFixed = 1e6;  // an absurd reply must not make the column unreadable
  return value < kLargestFixed ? formatFixed(value, 4) : formatScientific(value, 4);
}

Row tableRow(const SequenceSummary& summary) {
  Row row{summary.name, summary.kind, std::to_string(summary.error.count)};
  for (const std::size_t count : summary.outcomes) row.push_back(std::to_string(count));
  const Statistics& error = summary.error;
  for (const double value : {error.median, error.q75, error.q95, error.mean, error.stddev}) {
    row.push_back(formatError(value));
  }
  return row;
}

}  // namespace

std::vector<SequenceSummary> summarize(const std::vector<Result>& results) {
  std::map<Group, Tally> groups;
  std::map<std::string, std::set<std::string>> data_sets_of_sequence;
  std::set<Kind> kinds;
  Tally total;
  for (const Result& result : results) {
    const ProblemKey& key = result.key;
    groups[{key.data_set, key.sequence, key.kind}].add(result);
    data_sets_of_sequence[key.sequence].insert(key.data_set);
    kinds.insert(key.kind);
    total.add(result);
  }
  std::vector<SequenceSummary> summaries;
  for (const auto& [group, tally] : groups) {
    const auto& [data_set, sequence, kind] = group;
    const bool ambiguous = data_sets_of_sequence[sequence].size() > 1;
    summaries.push_back(
        tally.summary(ambiguous ? data_set + "/" + sequence : sequence, toString(kind)));
  }
  summaries.push_back(total.summary("total", kinds.size() == 1 ? toString(*kinds.begin()) : "all"));
  return summaries;
}

std::string formatSummary(const std::vector<SequenceSummary>& summaries) {
  Row header{"sequence", "kind", "count"};
  for (std::size_t i = 0; i < SequenceSummary{}.outcomes.size(); ++i) {
    header.emplace_back(toString(static_cast<Outcome>(i)));
  }
  for (const char* name : {"median", "q75", "q95", "mean", "stddev"}) header.emplace_back(name);
  std::vector<Row> rows{header};
  for (const SequenceSummary& summary : summaries) rows.push_back(tableRow(summary));
  constexpr std::size_t kTextColumns = 2;
  return alignColumns(rows, kTextColumns);
}

std::string describeScans(const std::vector<Result>& results) {
  std::vector<double> errors, misalignments;
  std::size_t worse = 0, unsettled = 0;
  for (const Result& result : results) {
    if (result.outcome != Outcome::kReplied || !result.scans_used) continue;
    errors.push_back(result.error);
    misalignments.push_back(result.initial_misalignment);
    worse += result.error > result.initial_misalignment ? 1 : 0;
    unsettled += startsWith(result.reason, kNotSettled) ? 1 : 0;
  }
  if (errors.empty()) return "";
  const std::string of_replies = " of " + std::to_string(errors.size()) + " replies";
  const double error = describe(errors).median, untouched = describe(misalignments).median;
  std::string text = "\ndo nothing: median " + formatError(untouched) +
                     "; worse than that: " + std::to_string(worse) + of_replies +
                     "; not settled: " + std::to_string(unsettled) + of_replies + "\n";
  if (error > untouched) {
    text += "warning: the replies are worse than doing nothing: median " + formatError(error) +
            " of those that came\n";
  }
  return text;
}

}  // namespace pcrb
