#include "report/add_details.hpp"

#include <filesystem>
#include <iostream>
#include <set>

#include "pcrb_core/error.hpp"

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

std::string nameOf(const ScoredProblem& problem) {
  return problem.key.data_set + "/" + problem.key.sequence;
}

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Sequences of the results whose ground truth has a known accuracy.
std::set<std::string> sequencesWithAccuracy(const std::string& path,
                                            const std::vector<GroundTruth>& accuracies,
                                            const std::vector<Entry>& entries) {
  std::set<std::string> here, known, elsewhere;
  for (const Entry& entry : entries) {
    for (const ScoredProblem& problem : entry.problems) here.insert(nameOf(problem));
  }
  for (const GroundTruth& accuracy : accuracies) {
    const std::string name = accuracy.data_set + "/" + accuracy.sequence;
    (here.count(name) > 0 ? known : elsewhere).insert(name);
  }
  if (known.empty()) {
    throw pcrb::InvalidFile(path, 0, elsewhere.empty() ? "no row" : "only " + joined(elsewhere),
                            "a sequence of the results: " + joined(here));
  }
  if (!elsewhere.empty()) {
    std::cerr << path << ": not in the results, so not shown: " << joined(elsewhere) << std::endl;
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
      const std::string name = nameOf(problem);
      if (found == details.end() || sequences.count(name) == 0) continue;
      found->second.addErrorPerMetre(problem);
      missing.erase(name);
    }
  }
  if (!details.empty()) progress.finish();
  if (missing.empty()) return;
  std::cerr << options.ground_truth << ": no floor, which takes the clouds (--root says where they "
            << "are): " << joined(missing) << std::endl;
}

}  // namespace

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

}  // namespace pcrb_tools
