#include "report/entries.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "common/series_file.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "report/published.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

ScoredProblem fromResult(const pcrb::Result& result) {
  ScoredProblem problem;
  problem.key = result.key;
  problem.source = result.source;
  problem.target = result.target;
  problem.overlap = result.overlap;
  problem.outcome = result.outcome;
  problem.reason = result.reason;
  problem.error = result.error;
  problem.initial_misalignment = result.initial_misalignment;
  problem.rotation_error = result.rotation_error;
  problem.translation_error = result.translation_error;
  problem.runtime = result.runtime;
  problem.solver_time = result.solver_time;
  problem.target_changed = result.target_changed;
  problem.finished = result.finished;
  if (result.position && result.orientation) {
    problem.reply = pcrb::makeTransform(*result.position, *result.orientation);
    problem.covariance = result.covariance;
  }
  return problem;
}

/// Splits problems by kind into entries that are alike otherwise.
void addByKind(const Entry& frame, std::vector<ScoredProblem> problems,
               std::vector<Entry>& entries) {
  for (const pcrb::Kind kind : {pcrb::Kind::kLocal, pcrb::Kind::kGlobal}) {
    Entry entry = frame;
    entry.kind = kind;
    for (ScoredProblem& problem : problems) {
      if (problem.key.kind != kind) continue;
      problem.pair = pairOf(problem);
      entry.problems.push_back(std::move(problem));
    }
    if (entry.problems.empty()) continue;
    std::sort(entry.problems.begin(), entry.problems.end(), [](const auto& a, const auto& b) {
      return a.key < b.key || (a.key == b.key && a.trial < b.trial);
    });
    for (std::size_t i = 1; i < entry.problems.size(); ++i) {
      if (entry.problems[i].key == entry.problems[i - 1].key &&
          entry.problems[i].trial == entry.problems[i - 1].trial) {
        throw pcrb::InvalidFile(entry.path, 0,
                                "problem " + entry.problems[i].key.problem_id + " of " +
                                    entry.problems[i].key.sequence + " twice",
                                "every problem once");
      }
    }
    entries.push_back(std::move(entry));
  }
}

/// Adds a run's problems; of several trials the first says what the run is.
void addResults(const std::string& path, int trial, Entry& frame,
                std::vector<ScoredProblem>& problems) {
  const pcrb::ResultsStore store(path, pcrb::ResultsStore::Access::kReadOnly);
  if (!frame.info) frame.info = pcrb::RunInfo::read(store);
  const std::size_t before = problems.size();
  auto scans = store.scans();
  for (const pcrb::Result& result : store.results()) {
    problems.push_back(fromResult(result));
    problems.back().trial = trial;
    problems.back().scans = std::move(scans[result.key]);
  }
  if (problems.size() == before) throw pcrb::InvalidFile(store.path(), "holds no result yet");
}

/// One entry per value of a series, with the problems of all trials.
void addSeries(const NamedPath& place, const std::string& name, const std::vector<SeriesRun>& runs,
               std::vector<Entry>& entries) {
  std::vector<std::pair<std::string, std::string>> values;  // parameter, value
  for (const SeriesRun& run : runs) {
    const std::pair value(run.parameter, run.value);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  for (const auto& [parameter, value] : values) {
    Entry frame;
    frame.path = place.path;
    frame.series = name;
    frame.trials = 0;
    std::vector<ScoredProblem> problems;
    for (const SeriesRun& run : runs) {
      if (run.parameter != parameter || run.value != value) continue;
      const std::string folder = place.path + "/" + run.folder;
      if (!fs::exists(folder + "/results.sqlite")) {
        std::cerr << folder << " has no results yet, and is left out" << std::endl;
        continue;
      }
      addResults(folder, run.trial, frame, problems);
      frame.trial_folders[run.trial] = folder;
      ++frame.trials;
    }
    frame.parameter = parameter;
    if (frame.trials == 0) continue;
    frame.value = value;
    frame.method = frame.parameter.empty() ? name : name + " " + frame.parameter + "=" + value;
    addByKind(frame, std::move(problems), entries);
  }
}

void addRun(const std::string& text, std::vector<Entry>& entries) {
  const NamedPath run = parseNamed(text);
  const std::string name = run.name.empty() ? lastName(run.path) : run.name;
  const auto series = readSeries(run.path);
  if (!series.empty()) return addSeries(run, name, series, entries);
  Entry frame;
  frame.method = name;
  frame.path = run.path;
  std::vector<ScoredProblem> problems;
  addResults(run.path, 0, frame, problems);
  addByKind(frame, std::move(problems), entries);
}

Import readImport(const std::string& text, const std::string& format,
                  const std::map<std::string, std::string>& data_sets) {
  const NamedPath file = parseNamed(text);
  Import import = importResults(file.name, file.path, format, data_sets);
  std::cerr << "read " << file.path << " as method " << import.method;
  if (!import.sequence.empty()) std::cerr << ", sequence " << import.sequence;
  std::cerr << std::endl;
  return import;
}

/// Files of one method make one entry.
void addImports(const ReportOptions& options, std::vector<Entry>& entries) {
  if (options.imports.empty()) return;
  const auto data_sets = knownSequences(options.root);
  std::vector<Import> imports;
  for (const std::string& text : options.imports) {
    Import import = readImport(text, options.format, data_sets);
    const auto same = std::find_if(imports.begin(), imports.end(), [&](const Import& other) {
      return other.method == import.method;
    });
    if (same == imports.end()) {
      imports.push_back(std::move(import));
      continue;
    }
    for (ScoredProblem& problem : import.problems) same->problems.push_back(std::move(problem));
  }
  for (Import& import : imports) {
    Entry frame;
    frame.method = import.method;
    frame.path = import.path;
    addByKind(frame, std::move(import.problems), entries);
  }
}

void requireDistinct(const std::vector<Entry>& entries) {
  for (auto a = entries.begin(); a != entries.end(); ++a) {
    for (auto b = entries.begin(); b != a; ++b) {
      if (a->method == b->method && a->kind == b->kind) {
        throw pcrb::InvalidParameter("found two runs called `" + a->method + "`, " + b->path +
                                     " and " + a->path + ": name them apart, NAME=FOLDER");
      }
    }
  }
}

}  // namespace

NamedPath parseNamed(const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign != std::string::npos && sign > 0 && !fs::exists(text) &&
      text.substr(0, sign).find('/') == std::string::npos) {
    return {text.substr(0, sign), text.substr(sign + 1)};
  }
  return {"", text};
}

std::string lastName(const std::string& path) {
  const fs::path folder = fs::absolute(path).lexically_normal();
  return (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

std::vector<Entry> loadEntries(const ReportOptions& options) {
  std::vector<Entry> entries;
  for (const std::string& run : options.runs) addRun(run, entries);
  addImports(options, entries);
  if (entries.empty() && options.trackers.empty()) {
    throw pcrb::InvalidParameter("found no run and no import, expected one at least");
  }
  requireDistinct(entries);
  return entries;
}

}  // namespace pcrb_tools
