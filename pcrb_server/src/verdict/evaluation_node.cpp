#include "verdict/evaluation_node.hpp"

#include <chrono>
#include <cstring>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_server/node_parameters.hpp"
#include "verdict/evaluation.hpp"
#include "verdict/run_watcher.hpp"

namespace pcrb {

namespace {

struct Parameters {
  Thresholds thresholds;
  double time_limit_total = 3600.0;
  std::string server;
  std::vector<std::string> clients;
  std::string run;
};

Parameters readParameters() {
  constexpr double kAny = std::numeric_limits<double>::max();
  NodeParameters reader;
  Parameters parameters;
  const auto threshold = [&](const char* name, const char* fallback, double max) {
    Threshold result;
    const auto words = reader.words(name, fallback);
    reader.check([&] { result = Threshold(name, words, max); });
    return result;
  };
  parameters.thresholds.max_median = threshold("max_median", "", kAny);
  parameters.thresholds.max_q95 = threshold("max_q95", "", kAny);
  parameters.thresholds.min_replied = threshold("min_replied", "1", 1.0);
  parameters.time_limit_total = reader.number("time_limit_total", 3600.0, 0.1, 1e9);
  parameters.server = reader.string("server", "benchmark_server");
  parameters.clients = reader.words("clients", "");
  parameters.run = reader.path("run");
  reader.finish();
  return parameters;
}

/// Writes the verdict while the watcher still keeps the server from ending: with the server,
/// rostest may end this node.
int report(JunitReport report, const std::string& run, double seconds, const std::string& file) {
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

int runEvaluation(const std::string& file, const ShutdownNotice& shutdown) {
  if (!file.empty()) {  // what is left if this node is killed
    writeFileAtomically(
        file, toXml(judgeUnfinished("the run did not finish: evaluation_test was killed")));
  }
  const auto start = std::chrono::steady_clock::now();
  Parameters parameters;
  const auto conclude = [&](const JunitReport& verdict) {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    return report(verdict, parameters.run, took.count(), file);
  };
  try {
    parameters = readParameters();
    RunWatcher watcher(parameters.server, parameters.clients);
    const auto summary = watcher.wait(parameters.time_limit_total, shutdown);
    return conclude(judge(summary, parameters.thresholds));
  } catch (const Error& error) {
    return conclude(judgeUnfinished(error.what()));
  }
}

}  // namespace pcrb
