#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "pcrb_core/evaluation/statistics.hpp"
#include "report/published.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

std::array<std::size_t, 5> outcomesOf(const Problems& problems) {
  std::array<std::size_t, 5> counts{};
  for (const ScoredProblem* problem : problems) {
    ++counts.at(static_cast<std::size_t>(problem->outcome));
  }
  return counts;
}

void appendStatistics(const pcrb::Statistics& statistics, std::vector<Json>& row) {
  for (const double value :
       {statistics.median, statistics.q75, statistics.q95, statistics.mean, statistics.stddev}) {
    row.push_back(number(value));
  }
}

std::vector<Json> scoreRow(const Entry& entry, const Selection& selection,
                           const ReportOptions& options) {
  const Problems problems = select(entry, selection);
  std::vector<Json> row{entry.method, selection.name, selection.level, problems.size()};
  for (const std::size_t count : outcomesOf(problems)) {
    row.push_back(entry.method == kBaseline ? Json(nullptr) : Json(count));
  }
  appendStatistics(pcrb::describe(errorsOf(problems)), row);
  const MedianInterval interval = medianIntervalOf(problems, options);
  row.insert(row.end(), {interval.low, interval.high, Json(interval.pairs)});
  return row;
}

/// Where medians side by side are not of the same problems.
std::string noteOnSharedProblems(const Section& section) {
  std::string places;
  for (const Selection* selection : section.at({"sequence", "total"})) {
    const ProblemCounts counts = countProblems(section, *selection);
    if (counts.shared == counts.all) continue;
    places += (places.empty() ? "" : ", ") + std::to_string(counts.shared) + " of " +
              std::to_string(counts.all) + " in " + selection->name;
  }
  if (places.empty()) return {};
  return " Not all methods have the same problems; where they have not, scores do not rank them: "
         "all "
         "share " +
         places + ".";
}

bool hasBothKinds(const std::vector<Section>& sections, const std::string& method) {
  std::size_t kinds = 0;
  for (const Section& section : sections) {
    for (const Entry* entry : section.entries) kinds += entry->method == method ? 1 : 0;
  }
  return kinds > 1;
}

}  // namespace

MedianInterval medianIntervalOf(const Problems& problems, const ReportOptions& options) {
  pcrb::BootstrapOptions bootstrap;
  bootstrap.resamples = options.resamples;
  bootstrap.seed = options.seed;
  const auto units = unitsOf(problems);
  MedianInterval found;
  found.pairs = units.empty() ? 0 : *std::max_element(units.begin(), units.end()) + 1;
  if (found.pairs < kFewestPairs) return found;
  const auto interval = pcrb::medianInterval(errorsOf(problems), units, bootstrap);
  found.low = number(interval.low);
  found.high = number(interval.high);
  return found;
}

Table scoreTable(const Section& section, const ReportOptions& options) {
  Table table{
      "scores",
      "Errors and outcomes",
      "median is the score; low and high are the ends of its 95 % bootstrap interval over "
      "pairs of clouds, of which there must be 6; stddev has n in the denominator; a problem "
      "without a valid reply "
      "counts with its initial misalignment, and `do nothing` is that of all problems: a method "
      "above it makes things worse. Groups are by characteristics that this suite "
      "or a dataset.yaml assigns, not by the paper's Tables 2 and 3.",
      {{"method"}, {"selection"}, {"level"}, {"problems", Format::kCount}},
      {}};
  for (std::size_t i = 0; i < 5; ++i) {
    table.columns.push_back({pcrb::toString(static_cast<pcrb::Outcome>(i)), Format::kCount});
  }
  for (const char* name : {"median", "q75", "q95", "mean", "stddev", "low", "high"}) {
    table.columns.push_back({name, Format::kError});
  }
  table.columns.push_back({"pairs", Format::kCount});
  table.note += noteOnSharedProblems(section);
  for (const Entry* entry : section.withBaseline()) {
    for (const Selection& selection : section.selections) {
      if (!select(*entry, selection).empty()) {
        table.rows.push_back(scoreRow(*entry, selection, options));
      }
    }
  }
  return table;
}

Table summaryTable(const std::vector<Section>& sections) {
  Table table{"summary",
              "Summary",
              "Error per sequence; the total pools problems, not sequences.",
              {{"method"}, {"sequence"}},
              {}};
  for (const char* name : {"median", "q75", "q95", "mean", "stddev"}) {
    table.columns.push_back({name, Format::kError});
  }
  for (const Section& section : sections) {
    for (const Entry* entry : section.entries) {
      std::string method = entry->method;
      if (hasBothKinds(sections, method)) {
        method += std::string(" (") + pcrb::toString(section.kind) + ")";
      }
      for (const Selection* selection : section.at({"sequence", "total"})) {
        const Problems problems = select(*entry, *selection);
        if (problems.empty()) continue;
        std::vector<Json> row{method, selection->name};
        appendStatistics(pcrb::describe(errorsOf(problems)), row);
        table.rows.push_back(std::move(row));
      }
    }
  }
  return table;
}

Table publishedTable(const Section& section) {
  Table table{
      "published",
      "As published",
      "Fontana et al. 2021, Tables 4-7 and 9-11, from the complete public data: to be "
      "compared with complete runs on the same data only. urban05 was computed in float32 "
      "at coordinates of 8e6 m, where one unit in the last place is 0.5 m: not comparable. ICP "
      "and NDT were probably stopped after one to four iterations by PCL's squared epsilon: "
      "the methods icp_pcl and ndt_pcl behave so, icp and ndt do what the paper's text says.",
      {{"method"}, {"sequence"}},
      {}};
  for (const char* name : {"median", "q75", "q95", "mean", "stddev"}) {
    table.columns.push_back({name, Format::kPublished});
  }
  if (!section.own_problems.empty()) {
    table.note +=
        " The problems of these sequences (drawn by sample_problems, or with ids of their own) "
        "are other ones than the published ones, the data perhaps too, whatever the name: " +
        namesOfOwnProblems(section) + ".";
  }
  for (const PublishedRow& published : publishedRows()) {
    if (published.kind != section.kind) continue;
    std::vector<Json> row{published.method, published.sequence};
    for (const double value : published.statistics) row.emplace_back(value);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace pcrb_tools
