#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/io/number.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

/// The median of each trial.
std::vector<double> mediansOfTrials(const Problems& problems) {
  std::map<int, std::vector<double>> errors;
  for (const ScoredProblem* problem : problems) errors[problem->trial].push_back(problem->error);
  std::vector<double> medians;
  for (const auto& [trial, values] : errors) medians.push_back(pcrb::describe(values).median);
  return medians;
}

/// Largest less smallest error of each problem over its trials.
std::vector<double> spreadsOf(const Problems& problems) {
  std::map<pcrb::ProblemKey, std::vector<double>> errors;
  for (const ScoredProblem* problem : problems) errors[problem->key].push_back(problem->error);
  std::vector<double> spreads;
  for (const auto& [key, values] : errors) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    spreads.push_back(*most - *least);
  }
  return spreads;
}

std::vector<Json> trialRow(const Entry& entry, const Selection& selection) {
  const Problems problems = select(entry, selection);
  const std::vector<double> medians = mediansOfTrials(problems);
  const std::vector<double> spreads = spreadsOf(problems);
  const auto [least, most] = std::minmax_element(medians.begin(), medians.end());
  const auto changed =
      std::count_if(spreads.begin(), spreads.end(), [](double s) { return s > 0.0; });
  return {entry.method,
          selection.name,
          medians.size(),
          number(*least),
          number(pcrb::describe(medians).median),
          number(*most),
          number(pcrb::describe(medians).stddev),
          number(pcrb::describe(spreads).median),
          number(pcrb::describe(spreads).q95),
          number(static_cast<double>(changed) / static_cast<double>(spreads.size()))};
}

}  // namespace

Table trialTable(const Section& section) {
  Table table{
      "trials",
      "Repeated runs",
      "Of the medians of the trials: the least, the middle and the largest, and their standard "
      "deviation; within problems: largest less smallest error of a problem over its trials, "
      "median and 0.95 quantile; changed: fraction of the problems whose error was not the "
      "same in all trials. Medians and intervals elsewhere are over all trials, intervals by "
      "resampling pairs of clouds with all their problems and trials.",
      {{"method"}, {"selection"}, {"trials", Format::kCount}},
      {}};
  for (const char* name : {"least", "median", "largest", "stddev", "within median", "within q95"}) {
    table.columns.push_back({name, Format::kError});
  }
  table.columns.push_back({"changed", Format::kFraction});
  for (const Entry* entry : section.entries) {
    if (entry->trials < 2) continue;
    for (const Selection* selection : section.at({"sequence", "total"})) {
      if (!select(*entry, *selection).empty()) table.rows.push_back(trialRow(*entry, *selection));
    }
  }
  return table;
}

Table sweepTable(const Section& section, const ReportOptions& options) {
  Table table{
      "sweeps",
      "Sweeps",
      "The median error over the values of a parameter; low and high are the ends of its 95 % "
      "bootstrap interval over pairs of clouds, of which there must be 6.",
      {{"series"}, {"parameter"}, {"value"}, {"method"}, {"problems", Format::kCount}},
      {}};
  for (const char* name : {"median", "low", "high", "q95"}) {
    table.columns.push_back({name, Format::kError});
  }
  for (const Entry* entry : section.entries) {
    if (entry->parameter.empty()) continue;
    const Problems problems = select(*entry, *section.at({"total"}).front());
    const auto errors = errorsOf(problems);
    const auto statistics = pcrb::describe(errors);
    const MedianInterval interval = medianIntervalOf(problems, options);
    const auto value = pcrb::parseDouble(entry->value);
    table.rows.push_back({entry->series, entry->parameter,
                          value ? Json(*value) : Json(entry->value), entry->method, errors.size(),
                          number(statistics.median), interval.low, interval.high,
                          number(statistics.q95)});
  }
  std::stable_sort(table.rows.begin(), table.rows.end(), [](const auto& a, const auto& b) {
    return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);  // by value, in the end
  });
  return table;
}

}  // namespace pcrb_tools
