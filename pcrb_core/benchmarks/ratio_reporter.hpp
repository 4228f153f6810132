#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcrb_benchmark {

/// Reports to the console and prints afterwards how many times as fast as its peer something is.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const bool is_time = run.run_type == Run::RT_Iteration || run.aggregate_name == "median";
      if (!is_time || run.error_occurred) continue;
      times_[run.run_name.function_name].push_back(
          {run.GetAdjustedCPUTime(), run.GetAdjustedRealTime()});
    }
    ConsoleReporter::ReportRuns(runs);
  }

  /// Prints the ratio of the median CPU times of all repetitions: what other programs on the
  /// machine disturb least. For work of one thread.
  void printCpuRatio(const std::string& peer, const std::string& subject) const {
    const double ratio = median(peer, &Times::cpu) / median(subject, &Times::cpu);
    std::printf("%s is %.2f times as fast as %s (CPU time)\n", subject.c_str(), ratio,
                peer.c_str());
  }

  /// The same of wall times: for work of several threads.
  void printRealRatio(const std::string& peer, const std::string& subject) const {
    const double ratio = median(peer, &Times::real) / median(subject, &Times::real);
    std::printf("%s is %.2f times as fast as %s (wall time)\n", subject.c_str(), ratio,
                peer.c_str());
  }

 private:
  struct Times {
    double cpu;
    double real;
  };

  double median(const std::string& name, double Times::*clock) const {
    const auto found = times_.find(name);
    if (found == times_.end()) throw std::runtime_error("benchmark " + name + " did not run");
    std::vector<double> values;
    for (const Times& times : found->second) values.push_back(times.*clock);
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }

  std::map<std::string, std::vector<Times>> times_;
};

}  // namespace pcrb_benchmark
