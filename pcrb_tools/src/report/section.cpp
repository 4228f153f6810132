#include "report/section.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "report/published.hpp"

namespace pcrb_tools {
namespace {

using SequenceKey = std::pair<std::string, std::string>;  // data set, sequence

std::vector<SequenceKey> sequencesOf(const Section& section) {
  std::set<SequenceKey> found;
  for (const Entry* entry : section.entries) {
    for (const auto& problem : entry->problems) {
      found.insert({problem.key.data_set, problem.key.sequence});
    }
  }
  std::vector<SequenceKey> ordered(found.begin(), found.end());
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) {
    return publishedPlace(a.second) < publishedPlace(b.second);
  });
  return ordered;
}

/// Adds a selection per value of a property, in the order in which sequences have them first.
template <typename PropertiesOf>
void addGroups(const std::string& level, const std::vector<SequenceKey>& sequences,
               const PropertiesOf& propertiesOf, std::vector<Selection>& selections) {
  std::vector<Selection> groups;
  for (const SequenceKey& sequence : sequences) {
    for (const std::string& property : propertiesOf(sequence)) {
      auto group = std::find_if(groups.begin(), groups.end(),
                                [&](const Selection& known) { return known.name == property; });
      if (group == groups.end()) group = groups.insert(group, {property, level, {}});
      group->sequences.insert(sequence);
    }
  }
  selections.insert(selections.end(), groups.begin(), groups.end());
}

/// Removes the selections from the `known`-th on that hold the same sequences as one before them.
void dropRepetitions(std::size_t known, std::vector<Selection>& selections) {
  for (std::size_t i = known; i < selections.size();) {
    const auto begin = selections.begin(), here = begin + static_cast<std::ptrdiff_t>(i);
    const bool is_repetition = std::any_of(
        begin, here, [&](const Selection& other) { return other.sequences == here->sequences; });
    if (is_repetition) {
      selections.erase(here);
    } else {
      ++i;
    }
  }
}

void addTotals(const std::vector<SequenceKey>& sequences, std::vector<Selection>& selections) {
  Selection total{"total", "total", {sequences.begin(), sequences.end()}};
  selections.push_back(total);
  const SequenceKey urban{"kaist", "urban05"};  // its published figures are not comparable
  if (total.sequences.erase(urban) == 0 || total.sequences.empty()) return;
  total.name = "total without urban05";
  selections.push_back(total);
}

void addSelections(const std::string& root, Section& section) {
  using Words = std::vector<std::string>;
  const auto sequences = sequencesOf(section);
  std::map<std::string, int> holders;
  for (const auto& sequence : sequences) ++holders[sequence.second];
  for (const auto& sequence : sequences) {
    const bool is_unique = holders[sequence.second] == 1;
    const std::string name = (is_unique ? "" : sequence.first + "/") + sequence.second;
    section.selections.push_back({name, "sequence", {sequence}});
  }
  addGroups(
      "data set", sequences, [](const SequenceKey& key) { return Words{key.first}; },
      section.selections);
  const std::size_t known = section.selections.size();
  addGroups(
      "group", sequences,
      [&](const SequenceKey& key) { return characteristicsOf(root, key.first, key.second); },
      section.selections);
  dropRepetitions(known, section.selections);
  addTotals(sequences, section.selections);
}

/// The problem as if its initial guess were the reply, as far as that is known.
ScoredProblem untouchedProblem(const ScoredProblem& problem) {
  ScoredProblem untouched;
  untouched.key = problem.key;
  untouched.source = problem.source;
  untouched.target = problem.target;
  untouched.pair = problem.pair;
  untouched.overlap = problem.overlap;
  untouched.initial_misalignment = problem.initial_misalignment;
  untouched.error = *problem.initial_misalignment;
  if (problem.untouched) {
    untouched.rotation_error = problem.untouched->rotation_error;
    untouched.translation_error = problem.untouched->translation_error;
    untouched.components = problem.untouched->components;
  } else if (!problem.isAnswered()) {  // it was scored with its initial guess
    untouched.rotation_error = problem.rotation_error;
    untouched.translation_error = problem.translation_error;
  }
  return untouched;
}

/// Each problem of some entry once, with its initial misalignment as its error.
std::optional<Entry> makeBaseline(const std::vector<const Entry*>& entries) {
  std::map<pcrb::ProblemKey, ScoredProblem> problems;
  for (const Entry* entry : entries) {
    for (const ScoredProblem& problem : entry->problems) {
      if (!problem.initial_misalignment) continue;
      const auto known = problems.find(problem.key);
      if (known == problems.end()) {
        problems.emplace(problem.key, untouchedProblem(problem));
      } else if (!known->second.components) {
        const ScoredProblem other = untouchedProblem(problem);
        if (other.rotation_error) known->second = other;  // it knows more
      }
    }
  }
  if (problems.empty()) return std::nullopt;
  Entry baseline;
  baseline.method = kBaseline;
  baseline.kind = entries.front()->kind;
  for (auto& [key, problem] : problems) baseline.problems.push_back(std::move(problem));
  return baseline;
}

/// The baseline stands for a run of the method that does the same.
void dropBaselineRun(Section& section) {
  auto& entries = section.entries;
  if (!section.baseline || entries.size() < 2) return;
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [](const Entry* entry) { return entry->method == kBaselineRun; }),
                entries.end());
}

}  // namespace

std::vector<const Entry*> Section::withBaseline() const {
  std::vector<const Entry*> all = entries;
  if (baseline) all.push_back(&*baseline);
  return all;
}

std::vector<const Selection*> Section::at(const std::set<std::string>& levels) const {
  std::vector<const Selection*> found;
  for (const Selection& selection : selections) {
    if (levels.count(selection.level) > 0) found.push_back(&selection);
  }
  return found;
}

std::vector<Section> makeSections(const std::vector<Entry>& entries, const std::string& root) {
  std::vector<Section> sections;
  for (const pcrb::Kind kind : {pcrb::Kind::kLocal, pcrb::Kind::kGlobal}) {
    Section section;
    section.kind = kind;
    for (const Entry& entry : entries) {
      if (entry.kind == kind) section.entries.push_back(&entry);
    }
    if (section.entries.empty()) continue;
    addSelections(root, section);
    section.own_problems = findOwnProblems(section.entries, root);
    section.baseline = makeBaseline(section.entries);
    dropBaselineRun(section);
    sections.push_back(std::move(section));
  }
  return sections;
}

Problems select(const Entry& entry, const Selection& selection) {
  Problems problems;
  for (const ScoredProblem& problem : entry.problems) {
    if (selection.sequences.count({problem.key.data_set, problem.key.sequence}) > 0) {
      problems.push_back(&problem);
    }
  }
  return problems;
}

std::vector<double> errorsOf(const Problems& problems) {
  std::vector<double> errors;
  for (const ScoredProblem* problem : problems) errors.push_back(problem->error);
  return errors;
}

std::vector<std::size_t> unitsOf(const Problems& problems) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::size_t> units;
  for (const ScoredProblem* problem : problems) {
    units.push_back(numbers.emplace(problem->pair, numbers.size()).first->second);
  }
  return units;
}

SharedErrors sharedErrors(const Entry& a, const Entry& b, const Selection& selection) {
  std::map<pcrb::ProblemKey, std::vector<double>> of_b;  // of all trials
  for (const ScoredProblem* problem : select(b, selection)) {
    of_b[problem->key].push_back(problem->error);
  }
  SharedErrors shared;
  for (const ScoredProblem* problem : select(a, selection)) {
    const auto found = of_b.find(problem->key);
    if (found == of_b.end()) continue;
    auto& errors = shared.by_pair[problem->pair];
    errors[0].push_back(problem->error);
    errors[1].insert(errors[1].end(), found->second.begin(), found->second.end());
    if (!found->second.empty()) ++shared.problems;
    found->second.clear();  // they count once, however many trials a has
  }
  return shared;
}

std::vector<double> overlapsOfProblems(const Section& section, const Selection& selection) {
  std::set<std::string> seen;
  std::vector<double> overlaps;
  for (const Entry* entry : section.entries) {
    for (const ScoredProblem* problem : select(*entry, selection)) {
      if (problem->overlap && seen.insert(problem->pair).second) {
        overlaps.push_back(*problem->overlap);
      }
    }
  }
  return overlaps;
}

ProblemCounts countProblems(const Section& section, const Selection& selection) {
  std::map<pcrb::ProblemKey, std::size_t> holders;
  std::size_t methods = 0;
  for (const Entry* entry : section.entries) {
    const Problems problems = select(*entry, selection);
    methods += problems.empty() ? 0 : 1;
    std::set<pcrb::ProblemKey> keys;  // a problem of several trials is one
    for (const ScoredProblem* problem : problems) keys.insert(problem->key);
    for (const pcrb::ProblemKey& key : keys) ++holders[key];
  }
  ProblemCounts counts;
  counts.all = holders.size();
  for (const auto& [key, count] : holders) counts.shared += count == methods ? 1 : 0;
  return counts;
}

std::string sequenceName(const Section& section, const pcrb::ProblemKey& key) {
  for (const Selection* selection : section.at({"sequence"})) {
    if (selection->sequences.count({key.data_set, key.sequence}) > 0) return selection->name;
  }
  return key.sequence;
}

std::vector<pcrb::ProblemOutcome> outcomesForSuccess(const Problems& problems) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  std::vector<pcrb::ProblemOutcome> outcomes;
  for (const ScoredProblem* problem : problems) {
    outcomes.push_back({problem->isAnswered(), problem->error,
                        problem->rotation_error.value_or(kNaN),
                        problem->translation_error.value_or(kNaN)});
  }
  return outcomes;
}

}  // namespace pcrb_tools
