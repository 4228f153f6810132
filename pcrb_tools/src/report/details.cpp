#include "report/details.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

/// The data set folder of an entry: the one that was asked for, else the run's, where it is there.
std::string rootOf(const Entry& entry, const ReportOptions& options) {
  if (!options.root.empty()) return options.root;
  const std::string root = entry.info ? entry.info->configuration.selection.root : "";
  return std::filesystem::is_directory(root) ? root : std::string();
}

std::size_t countProblems(const std::vector<Entry>& entries) {
  std::size_t count = 0;
  for (const Entry& entry : entries) count += entry.problems.size();
  return count;
}

std::string sequenceNameOf(const ScoredProblem& problem) {
  return problem.key.data_set + "/" + problem.key.sequence;
}

/// Sequences of the results whose ground truth has a known accuracy.
std::set<std::string> sequencesWithAccuracy(const std::string& path,
                                            const std::vector<GroundTruth>& accuracies,
                                            const std::vector<Entry>& entries) {
  std::set<std::string> here, known, elsewhere;
  for (const Entry& entry : entries) {
    for (const ScoredProblem& problem : entry.problems) here.insert(sequenceNameOf(problem));
  }
  for (const GroundTruth& accuracy : accuracies) {
    const std::string name = accuracy.data_set + "/" + accuracy.sequence;
    (here.count(name) > 0 ? known : elsewhere).insert(name);
  }
  if (known.empty()) {
    throw pcrb::InvalidFile(path, 0,
                            elsewhere.empty() ? "no row" : "only " + pcrb::joined(elsewhere),
                            "a sequence of the results: " + pcrb::joined(here));
  }
  if (!elsewhere.empty()) {
    std::cerr << path << ": not in the results, so not shown: " << pcrb::joined(elsewhere)
              << std::endl;
  }
  return known;
}

void addErrorsPerMetre(const ReportOptions& options, const std::set<std::string>& sequences,
                       DetailsByRoot& details, std::vector<Entry>& entries) {
  std::set<std::string> missing = sequences;
  Progress progress("floors of the ground truth", "problems", countProblems(entries));
  for (Entry& entry : entries) {
    const auto found = details.find(rootOf(entry, options));
    for (ScoredProblem& problem : entry.problems) {
      progress.add();
      const std::string name = sequenceNameOf(problem);
      if (found == details.end() || sequences.count(name) == 0) continue;
      found->second.addErrorPerMetre(problem);
      missing.erase(name);
    }
  }
  if (!details.empty()) progress.finish();
  if (missing.empty()) return;
  std::cerr << options.ground_truth << ": no floor, which takes the clouds (--root says where they "
            << "are): " << pcrb::joined(missing) << std::endl;
}

/// Median over a sequence's sources of the metric of a translation of 1 m.
std::optional<double> errorPerMetre(const Section& section, const Selection& selection) {
  std::vector<double> values;
  for (const Entry* entry : section.entries) {
    for (const ScoredProblem* problem : select(*entry, selection)) {
      if (problem->error_per_metre) values.push_back(*problem->error_per_metre);
    }
  }
  if (values.empty()) return std::nullopt;
  return pcrb::describe(std::move(values)).median;
}

}  // namespace

std::vector<GroundTruth> readGroundTruth(const std::string& path) {
  constexpr const char* kExpected = "columns data_set, sequence, mean and stddev";
  const pcrb::FileBytes file(path);
  pcrb::LineReader lines(file.text(), path);
  std::vector<std::string> header, row;
  if (!pcrb::nextCsvRow(lines, header)) throw pcrb::InvalidFile(path, 1, "nothing", kExpected);
  std::array<std::size_t, 4> places{};
  const std::array<const char*, 4> names{"data_set", "sequence", "mean", "stddev"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find(header.begin(), header.end(), names[i]);
    if (found == header.end()) lines.fail("no column `" + std::string(names[i]) + "`", kExpected);
    places[i] = static_cast<std::size_t>(found - header.begin());
  }
  const auto length = [&](std::string_view field) {
    const auto value = pcrb::parseDouble(field);
    if (!value || !std::isfinite(*value) || *value < 0.0) {
      lines.fail(pcrb::inQuotes(field), "a length in m");
    }
    return *value;
  };
  std::vector<GroundTruth> accuracies;
  while (pcrb::nextCsvRow(lines, row)) {
    if (row.size() != header.size()) {
      lines.fail(std::to_string(row.size()) + " fields", std::to_string(header.size()));
    }
    if (row[places[2]].empty() && row[places[3]].empty()) continue;  // no pair could be aligned
    accuracies.push_back(
        {row[places[0]], row[places[1]], length(row[places[2]]), length(row[places[3]])});
  }
  return accuracies;
}

DetailsByRoot addDetails(const ReportOptions& options, const std::vector<GroundTruth>& accuracies,
                         std::vector<Entry>& entries) {
  DetailsByRoot details;
  Progress progress("errors along each axis", "problems", countProblems(entries));
  for (Entry& entry : entries) {
    const std::string root = rootOf(entry, options);
    if (root.empty()) continue;
    ProblemDetails& found = details.try_emplace(root, root).first->second;
    found.addPairs(entry);
    if (options.with_components && entry.info) found.addComponents(entry, progress);
  }
  if (!details.empty() && options.with_components) progress.finish();
  if (options.ground_truth.empty()) return details;
  const auto sequences = sequencesWithAccuracy(options.ground_truth, accuracies, entries);
  addErrorsPerMetre(options, sequences, details, entries);
  return details;
}

Table groundTruthTable(const Section& section, const std::vector<GroundTruth>& accuracies) {
  Table table{"ground_truth",
              "Accuracy of the ground truth",
              "Mean and standard deviation in m, as evaluate_ground_truth finds them. floor is the "
              "error of a translation by the mean: methods cannot be told apart below it.",
              {{"data set"}, {"sequence"}},
              {}};
  for (const char* name : {"mean", "stddev", "floor"}) {
    table.columns.push_back({name, Format::kError});
  }
  for (const Selection* selection : section.at({"sequence"})) {
    const auto& [data_set, sequence] = *selection->sequences.begin();
    for (const GroundTruth& accuracy : accuracies) {
      if (accuracy.data_set != data_set || accuracy.sequence != sequence) continue;
      const auto scale = errorPerMetre(section, *selection);
      table.rows.push_back({data_set, selection->name, accuracy.mean, accuracy.stddev,
                            scale ? Json(accuracy.mean * *scale) : Json(nullptr)});
    }
  }
  return table;
}

}  // namespace pcrb_tools
