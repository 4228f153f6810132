#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pcrb_core/evaluation/distributions.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "report/scored_problem.hpp"

namespace pcrb_tools {

/// Some sequences whose problems are looked at together.
struct Selection {
  std::string name;
  std::string level;  ///< `sequence`, `data set`, `group` (a characteristic) or `total`
  std::set<std::pair<std::string, std::string>> sequences;  ///< data set, sequence
};

/// All that is compared with each other: the entries of one kind.
struct Section {
  pcrb::Kind kind = pcrb::Kind::kLocal;
  std::vector<const Entry*> entries;
  std::vector<Selection> selections;  ///< sequences, data sets, groups, total
  /// The entries' problems as a method leaves them that returns the initial guess: what a score is
  /// worth. None where no initial misalignment is known.
  std::optional<Entry> baseline;
  /// Of all pairs of clouds in the problem file of a sequence (data set, sequence), where known.
  std::map<std::pair<std::string, std::string>, std::vector<double>> overlaps;
  /// Of all pairs that they were drawn from, as the overlap matrix of a sequence says, where known.
  std::map<std::pair<std::string, std::string>, pcrb::Range> overlap_ranges;
  /// Sequences (data set, sequence) whose problems are not the published ones in some entry,
  /// whatever their name: a tool drew them, or ids are others.
  std::set<std::pair<std::string, std::string>> own_problems;

  /// The entries, and behind them the baseline, where there is one: what has a row or a mark.
  std::vector<const Entry*> withBaseline() const;

  /// Selections of some levels.
  std::vector<const Selection*> at(const std::set<std::string>& levels) const;
};

/// Name of the baseline among methods.
constexpr const char* kBaseline = "do nothing";

/// What a run of the method is called that returns the initial guess: where there are others, it is
/// the baseline, and no method beside them.
constexpr const char* kBaselineRun = "do_nothing";

/// One section per kind that has entries. The entries must outlive it.
///
/// @param root  folder whose `dataset.yaml` files say characteristics, and whose problem files say
///              which tool drew them; may be empty.
std::vector<Section> makeSections(const std::vector<Entry>& entries, const std::string& root);

using Problems = std::vector<const ScoredProblem*>;

/// Problems of an entry that a selection holds.
Problems select(const Entry& entry, const Selection& selection);

/// Errors, and the number from 0 of each one's pair of clouds.
std::vector<double> errorsOf(const Problems& problems);
std::vector<std::size_t> unitsOf(const Problems& problems);

/// Errors of two entries on the problems that both have, of all trials, by pair of clouds.
struct SharedErrors {
  std::map<std::string, std::array<std::vector<double>, 2>> by_pair;
  std::size_t problems = 0;
};
SharedErrors sharedErrors(const Entry& a, const Entry& b, const Selection& selection);

/// Overlaps of the pairs of clouds of all methods' selected problems, each pair's once.
std::vector<double> overlapsOfProblems(const Section& section, const Selection& selection);

/// Problems that some method has in a selection, and those that all methods have that have any
/// there: medians of different problems are no ranking.
struct ProblemCounts {
  std::size_t all = 0;
  std::size_t shared = 0;
};
ProblemCounts countProblems(const Section& section, const Selection& selection);

/// The name of a sequence in a section: with its data set where two data sets have one of that
/// name.
std::string sequenceName(const Section& section, const pcrb::ProblemKey& key);

/// The selected problems as success is counted.
std::vector<pcrb::ProblemOutcome> outcomesForSuccess(const Problems& problems);

/// Sequences (data set, sequence) of which some entry has problems that are not the published ones,
/// whatever their name: a tool drew them, as the run table or the problem file's side file says; or
/// an id is none that the published files have.
///
/// @param root  data set folder where problem files are looked for; may be empty.
std::set<std::pair<std::string, std::string>> findOwnProblems(
    const std::vector<const Entry*>& entries, const std::string& root);

/// Names of the sequences in own_problems, separated by commas.
std::string namesOfOwnProblems(const Section& section);

/// The row of the paper's tables that may stand beside a selection: its sequence's name or `total`;
/// empty if there is none or the problems are others. The total is one of all published sequences
/// and stands only beside theirs.
std::string publishedRowOf(const Section& section, const Selection& selection);

}  // namespace pcrb_tools
