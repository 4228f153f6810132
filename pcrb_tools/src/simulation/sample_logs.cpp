#include "simulation/sample_logs.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "common/progress.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/parallel.hpp"

namespace pcrb_tools::simulation {
namespace {

namespace fs = std::filesystem;

constexpr char kSettingsFile[] = "sample_logs.txt";
constexpr char kErrorsFile[] = "ground_truth_error.csv";

using Planner = LogPlan (*)(const LogOptions&);

const std::map<std::string, Planner>& planners() {
  static const std::map<std::string, Planner> by_data_set{{"eth", planEthLogs},
                                                          {"planetary", planPlanetaryLogs},
                                                          {"tum", planTumLogs},
                                                          {"kaist", planKaistLogs}};
  return by_data_set;
}

std::string settingsText(const SampleLogsRequest& request) {
  return "# Simulated by make_sample_logs: these logs are of no real sensor.\nseed " +
         std::to_string(request.seed) + "\nsize " + request.size + "\nground_truth_error " +
         pcrb::formatShortest(request.ground_truth_error) + "\n";
}

/// Claims the output folder: a new or empty one, or one with logs of the same settings.
void claimFolder(const SampleLogsRequest& request) {
  const std::string settings = settingsText(request);
  const fs::path folder = request.output;
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw pcrb::InvalidParameter("--output " + request.output +
                                 ": found a file, expected a folder");
  }
  if (fs::exists(folder / kSettingsFile)) {
    std::ifstream file(folder / kSettingsFile, std::ios::binary);
    const std::string found((std::istreambuf_iterator<char>(file)),
                            std::istreambuf_iterator<char>());
    if (found == settings) return;
    throw pcrb::InvalidParameter(request.output +
                                 ": has sample logs of another seed, size or error (see " +
                                 kSettingsFile + "): remove it or choose another --output");
  }
  if (fs::exists(folder) && !fs::is_empty(folder)) {
    throw pcrb::InvalidParameter(request.output +
                                 ": found a folder with other contents, expected a " +
                                 "new or empty one: simulated logs must not mix with real ones");
  }
  writeLogFile(request.output, kSettingsFile, settings);
}

std::string errorsText(const std::vector<KnownError>& errors) {
  std::string text = "data_set,sequence,cloud,x,y,z\n";
  for (const KnownError& known : errors) {
    text += known.data_set + "," + known.sequence + "," + known.cloud;
    for (const double value : known.error) {
      text += ",";
      pcrb::appendFixed(text, value, 6);
    }
    text += "\n";
  }
  return text;
}

bool isComplete(const LogJob& job, const fs::path& output) {
  return std::all_of(job.files.begin(), job.files.end(),
                     [&output](const std::string& file) { return fs::exists(output / file); });
}

void append(LogPlan& all, LogPlan plan) {
  std::move(plan.jobs.begin(), plan.jobs.end(), std::back_inserter(all.jobs));
  std::move(plan.errors.begin(), plan.errors.end(), std::back_inserter(all.errors));
}

}  // namespace

LogSize logSize(const std::string& name) {
  if (name == "small") return {7, 120, 340, 8, 180, 120, 9, 2, 6, 10, 1800};
  if (name == "medium") return {20, 200, 600, 30, 270, 220, 30, 1, 6, 60, 1800};
  if (name == "large") return {45, 344, 1077, 110, 360, 280, 120, 1, 10, 300, 1800};
  throw pcrb::InvalidParameter("--size: found '" + name + "', expected small, medium or large");
}

void makeSampleLogs(const SampleLogsRequest& request) {
  const LogOptions options{request.seed, logSize(request.size), request.ground_truth_error,
                           request.threads};
  if (!std::isfinite(options.ground_truth_error) || options.ground_truth_error < 0.0) {
    throw pcrb::InvalidParameter("--ground-truth-error: expected a length in m of at least 0");
  }
  LogPlan plan;
  for (const std::string& data_set : request.data_sets) {
    const auto planner = planners().find(data_set);
    if (planner == planners().end()) {
      throw pcrb::InvalidParameter("--data-set: found '" + data_set +
                                   "', expected eth, planetary, tum or kaist");
    }
    append(plan, planner->second(options));
  }
  claimFolder(request);
  if (options.ground_truth_error > 0.0) {
    writeLogFile(request.output, kErrorsFile, errorsText(plan.errors));
  }
  Progress progress("sample logs", "pieces", plan.jobs.size());
  pcrb::parallelFor(plan.jobs.size(), request.threads, [&](std::size_t i) {
    if (isComplete(plan.jobs[i], request.output)) {
      progress.keep(1);
      return;
    }
    plan.jobs[i].make(request.output);
    progress.add();
  });
  progress.finish();
}

}  // namespace pcrb_tools::simulation
