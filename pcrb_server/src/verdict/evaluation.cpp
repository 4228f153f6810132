#include "verdict/evaluation.hpp"

#include "pcrb_core/evaluation/summary.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {

namespace {

constexpr const char* kSuite = "evaluation";
constexpr const char* kRunCase = "run finished";

SequenceSummary toCore(const pcrb_msgs::SequenceSummary& row) {
  return {row.name,
          row.kind,
          {row.replied, row.failed, row.timed_out, row.rejected, row.skipped},
          {row.count, row.median, row.q75, row.q95, row.mean, row.stddev}};
}

std::string table(const pcrb_msgs::Summary& summary) {
  std::vector<SequenceSummary> rows;
  for (const auto& row : summary.sequences) rows.push_back(toCore(row));
  return formatSummary(rows);
}

void addThreshold(const char* name, const Threshold& threshold,
                  const pcrb_msgs::SequenceSummary& row, JunitCase& test) {
  if (const auto value = threshold.of(row))
    test.properties.emplace_back(name, formatShortest(*value));
}

JunitCase judgeRow(const pcrb_msgs::SequenceSummary& row, const Thresholds& thresholds) {
  const auto count = [](std::uint32_t number) { return std::to_string(number); };
  JunitCase test;
  test.name = row.name + " " + row.kind;
  test.properties = {{"count", count(row.count)},
                     {"replied", count(row.replied)},
                     {"failed", count(row.failed)},
                     {"timed_out", count(row.timed_out)},
                     {"rejected", count(row.rejected)},
                     {"skipped", count(row.skipped)},
                     {"replied_fraction", formatShortest(repliedFraction(row))},
                     {"median", formatShortest(row.median)},
                     {"q75", formatShortest(row.q75)},
                     {"q95", formatShortest(row.q95)},
                     {"mean", formatShortest(row.mean)},
                     {"stddev", formatShortest(row.stddev)}};
  addThreshold("max_median", thresholds.max_median, row, test);
  addThreshold("max_q95", thresholds.max_q95, row, test);
  addThreshold("min_replied", thresholds.min_replied, row, test);
  for (const auto& breach : breaches(row, thresholds)) {
    test.failure += (test.failure.empty() ? test.name + ": " : "; ") + breach;
  }
  return test;
}

/// A threshold for a sequence that is not there would pass unseen.
std::string unusedNames(const pcrb_msgs::Summary& summary, const Thresholds& thresholds) {
  std::string text;
  for (const auto* threshold :
       {&thresholds.max_median, &thresholds.max_q95, &thresholds.min_replied}) {
    for (const auto& name : threshold->unusedNames(summary.sequences)) text += " " + name;
  }
  return text.empty() ? "" : "thresholds are given for what is not in this run:" + text;
}

}  // namespace

JunitReport judge(const pcrb_msgs::Summary& summary, const Thresholds& thresholds) {
  JunitReport report;
  report.suite = kSuite;
  report.printed = table(summary);
  report.cases.push_back({kRunCase, {}, unusedNames(summary, thresholds)});
  for (const auto& row : summary.sequences) report.cases.push_back(judgeRow(row, thresholds));
  for (const auto& test : report.cases) {
    if (!test.failure.empty()) report.printed += "FAILED: " + test.failure + "\n";
  }
  return report;
}

JunitReport judgeUnfinished(const std::string& why) {
  JunitReport report;
  report.suite = kSuite;
  report.printed = "FAILED: " + why + "\n";
  report.cases.push_back({kRunCase, {}, why});
  return report;
}

}  // namespace pcrb
