#include "benchmarking/series.hpp"

#include <ros/package.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string_view>

#include "common/tool_main.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/registration/parameters.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// The value of a launch argument; empty where it is not given.
std::string argumentOf(const BatchOptions& options, const std::string& name) {
  const std::string prefix = name + ":=";
  for (const std::string& argument : options.arguments) {
    if (pcrb::startsWith(argument, prefix)) return argument.substr(prefix.size());
  }
  return "";
}

bool isSame(const SeriesRun& a, const SeriesRun& b) {
  return a.parameter == b.parameter && a.value == b.value && a.trial == b.trial;
}

/// Notes the series in its folder. A series may grow: trials and values are added.
void noteSeries(const BatchOptions& options, std::vector<SeriesRun>& runs) {
  fs::create_directories(options.run);
  if (fs::exists(options.run + "/batch.txt") || fs::exists(options.run + "/results.sqlite")) {
    throw pcrb::InvalidParameter(
        options.run + ": the folder holds a run, expected one for a series: give another");
  }
  pcrb::writeFileAtomically(options.run + "/" + kSeriesFile,
                            formatSeries(grown(readSeries(options.run), runs)));
}

/// Text of the parameter file of a run of a sweep.
std::string parametersOf(const BatchOptions& options, const SeriesRun& run) {
  const std::string method =
      argumentOf(options, "method").empty() ? "gicp" : argumentOf(options, "method");
  std::string file = argumentOf(options, "parameters");
  if (file.empty()) {
    file = ros::package::getPath("pcrb_launch") + "/config/methods/" + method + ".yaml";
  }
  return sweptParameters(file, method, run.parameter, run.value);
}

/// The launch arguments of a run of a sweep: with its own parameter file, which is written.
std::vector<std::string> sweptArguments(const BatchOptions& options, const SeriesRun& run) {
  const std::string path =
      fs::absolute(options.run + "/" + run.parameter + "=" + run.value + ".yaml").string();
  pcrb::writeFileAtomically(path, parametersOf(options, run));
  std::vector<std::string> arguments;
  for (const std::string& argument : options.arguments) {
    if (!pcrb::startsWith(argument, "parameters:=")) arguments.push_back(argument);
  }
  arguments.push_back("parameters:=" + path);
  return arguments;
}

}  // namespace

std::vector<SeriesRun> runsOfSeries(const SeriesOptions& options) {
  std::vector<std::string> values{""};
  std::string parameter;
  if (!options.sweep.empty()) {
    const std::size_t sign = options.sweep.find('=');
    parameter = options.sweep.substr(0, sign);
    std::vector<std::string_view> parts;
    if (sign != std::string::npos)
      pcrb::splitAt(',', std::string_view(options.sweep).substr(sign + 1), parts);
    values.assign(parts.begin(), parts.end());
    std::vector<std::string> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const bool is_twice = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    const bool is_bad = std::any_of(values.begin(), values.end(), [](const std::string& value) {
      return value.empty() || value.find('/') != std::string::npos;
    });
    if (parameter.empty() || parameter.find('/') != std::string::npos || values.empty() || is_bad ||
        is_twice) {
      throw pcrb::InvalidParameter("--sweep: found `" + options.sweep +
                                   "`, expected NAME=V1,V2,… with different values");
    }
  }
  std::vector<SeriesRun> runs;
  for (const std::string& value : values) {
    for (int trial = 1; trial <= options.repeat; ++trial) {
      SeriesRun run{parameter.empty() ? "" : parameter + "=" + value, parameter, value, trial};
      if (options.repeat > 1) {
        run.folder += std::string(run.folder.empty() ? "" : "/") + "trial_" + std::to_string(trial);
      }
      runs.push_back(run);
    }
  }
  return runs;
}

std::vector<SeriesRun> grown(std::vector<SeriesRun> all, std::vector<SeriesRun>& runs) {
  for (SeriesRun& run : runs) {
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&run](const SeriesRun& other) { return isSame(run, other); });
    if (known == all.end()) {
      all.push_back(run);
    } else {
      run.folder = known->folder;
    }
  }
  return all;
}

std::string sweptParameters(const std::string& file, const std::string& method,
                            const std::string& parameter, const std::string& value) {
  const pcrb::MethodParameters parameters(file);
  const std::string name = parameters.method().empty() ? method : parameters.method();
  const auto known = pcrb::registrationMethods();
  if (std::find(known.begin(), known.end(), name) != known.end()) {
    pcrb::Parameters tried{{parameter, value}};
    pcrb::makeRegistration(name, tried);  // says what is wrong with it
  }
  std::string text = "# " + method + " with another " + parameter + ", for a sweep.\n";
  if (!parameters.method().empty()) text += "method: " + parameters.method() + "\n";
  pcrb::Parameters common = parameters.asWritten("");
  common[parameter] = value;
  for (const auto& [key, number] : common) text += key + ": " + number + "\n";
  for (const std::string& data_set : parameters.dataSets()) {
    std::string different;
    for (const auto& [key, number] : parameters.asWritten(data_set)) {
      if (key == parameter || common.at(key) == number) continue;
      different += (different.empty() ? "" : ", ") + key + ": " + number;
    }
    if (!different.empty()) text += data_set + ": {" + different + "}\n";
  }
  return text;
}

int runSeriesTool(const BatchOptions& options, const SeriesOptions& series) {
  if (series.isOne()) {
    if (!readSeries(options.run).empty()) {
      throw pcrb::InvalidParameter(
          options.run +
          ": the folder holds a series, expected --repeat or --sweep: give another for one run");
    }
    return runBatchTool(options);
  }
  std::vector<SeriesRun> runs = runsOfSeries(series);
  for (const SeriesRun& run : runs) {
    if (!run.parameter.empty()) parametersOf(options, run);  // refused before anything is noted
  }
  noteSeries(options, runs);
  int status = kSuccess;
  for (const SeriesRun& run : runs) {
    BatchOptions one = options;
    one.run = options.run + "/" + run.folder;
    if (!options.scratch.empty()) one.scratch = options.scratch + "/" + run.folder;
    if (!run.parameter.empty()) one.arguments = sweptArguments(options, run);
    std::cout << run.folder << ":" << std::endl;
    status = std::max(status, runBatchTool(one));
  }
  return status;
}

}  // namespace pcrb_tools
