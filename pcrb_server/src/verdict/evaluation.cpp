#include "verdict/evaluation.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/run/summary.hpp"
#include "pcrb_server/node_parameters.hpp"
#include "verdict/launch_arguments.hpp"
#include "verdict/run_watcher.hpp"

namespace pcrb {

const ParameterTable kEvaluationParameters{
    {"max_median", "", "",
     "largest median of the error allowed: `0.1` for every sequence and the total, `0.1 hall=0.5 "
     "hall:global=0.8` with others for some; empty: no limit"},
    {"max_q95", "", "", "largest 0.95 quantile of the error allowed, in the same form"},
    {"min_replied", "", "",
     "least fraction of problems with a valid reply, in the same form; empty: 1. One of the three "
     "thresholds must be given"},
    {"time_limit_total", "3600", "s", "time from this node's start to the end of the run"},
    {"server", "benchmark_server", "", "name of the server's node"},
    {"clients", "", "",
     "names of nodes without which no problem is solved: the run has failed if one ends before it, "
     "or does not start"},
    {"run", "", "", "folder of the results, to be named in the report"},
    {"known_arguments", "", "",
     "names of the arguments of evaluate.test: others on its command line are mistakes; empty: not "
     "looked at"}};

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

void addUnknownArguments(NodeParameters& reader) {
  const std::vector<std::string> known = reader.words("known_arguments");
  if (known.empty()) return;
  for (const std::string& name : launchArguments(commandLineOfParent(), "evaluate.test")) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    reader.addMistake("evaluate.test has no argument " + inQuotes(name) + ": expected one of " +
                      joined(known, " ") + " (thresholds are max_median, max_q95 and min_replied)");
  }
}

struct EvaluationParameters {
  Thresholds thresholds;
  double time_limit_total = 3600.0;
  std::string server;
  std::vector<std::string> clients;
  std::string run;
};

EvaluationParameters readEvaluationParameters() {
  constexpr double kAny = std::numeric_limits<double>::max();
  NodeParameters reader(kEvaluationParameters);
  EvaluationParameters parameters;
  bool is_any_given = false;
  const auto threshold = [&](const char* name, double max, std::vector<std::string> fallback) {
    Threshold result;
    auto words = reader.words(name);
    is_any_given |= !words.empty();
    if (words.empty()) words = std::move(fallback);
    reader.check([&] { result = Threshold(name, words, max); });
    return result;
  };
  parameters.thresholds.max_median = threshold("max_median", kAny, {});
  parameters.thresholds.max_q95 = threshold("max_q95", kAny, {});
  parameters.thresholds.min_replied = threshold("min_replied", 1.0, {"1"});
  if (!is_any_given) {
    reader.addMistake(
        "no threshold is given: expected max_median, max_q95 or min_replied, such as "
        "max_median:=0.05");
  }
  addUnknownArguments(reader);
  parameters.time_limit_total = reader.number("time_limit_total", 0.1, 1e9);
  parameters.server = reader.string("server");
  parameters.clients = reader.words("clients");
  parameters.run = reader.path("run");
  reader.finish();
  return parameters;
}

/// Writes the verdict while the watcher still keeps the server from ending: with the server,
/// rostest may end this node.
int conclude(JunitReport report, const std::string& run, double seconds, const std::string& file) {
  report.seconds = seconds;
  if (!run.empty()) {
    report.printed += "results: " + run + "\n";
    report.cases.front().properties.emplace_back("run", run);
  }
  std::cout << report.printed << std::flush;
  if (!file.empty()) writeFileAtomically(file, toXml(report));
  return report.failures() == 0 ? 0 : 1;
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

std::string takeJunitFile(int& argc, char** argv) {
  constexpr const char* kFlag = "--gtest_output=xml:";
  std::string file;
  int kept = 0;
  for (int i = 0; i < argc; ++i) {
    if (std::strncmp(argv[i], kFlag, std::strlen(kFlag)) == 0) {
      file = argv[i] + std::strlen(kFlag);
    } else if (std::strcmp(argv[i], "--text") != 0) {
      argv[kept++] = argv[i];
    }
  }
  argc = kept;
  return file;
}

int runEvaluation(const std::string& file, const ShutdownRequest& shutdown) {
  if (!file.empty()) {  // what is left if this node is killed
    writeFileAtomically(
        file, toXml(judgeUnfinished("the run did not finish: evaluation_test was killed")));
  }
  const auto start = std::chrono::steady_clock::now();
  EvaluationParameters parameters;
  const auto end = [&](const JunitReport& verdict) {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    return conclude(verdict, parameters.run, took.count(), file);
  };
  try {
    parameters = readEvaluationParameters();
    RunWatcher watcher(parameters.server, parameters.clients);
    const auto summary = watcher.wait(parameters.time_limit_total, shutdown);
    return end(judge(summary, parameters.thresholds));
  } catch (const Error& error) {
    return end(judgeUnfinished(error.what()));
  }
}

}  // namespace pcrb
