#include <algorithm>

#include "pcrb_core/evaluation/rank_tests.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "report/published.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

struct Comparison {
  const Entry* a;
  const Entry* b;
  const Selection* selection;
  std::size_t problems = 0;
  std::size_t pairs = 0;
  pcrb::PairedTest test;  ///< of a's median error minus b's, per pair
};

Comparison compare(const Entry& a, const Entry& b, const Selection& selection) {
  const SharedErrors shared = sharedErrors(a, b, selection);
  std::vector<double> differences;
  for (const auto& [pair, errors] : shared.by_pair) {
    differences.push_back(pcrb::describe(errors[0]).median - pcrb::describe(errors[1]).median);
  }
  return {&a, &b, &selection, shared.problems, differences.size(), pcrb::wilcoxon(differences)};
}

/// The method that the test shows to be better, by its own rank sums; null if it shows neither.
Json better(const Comparison& comparison, double corrected_p) {
  if (corrected_p >= kSignificance) return nullptr;
  const bool is_a = comparison.test.positive < comparison.test.negative;
  return is_a ? comparison.a->method : comparison.b->method;
}

/// Whether the test could reject at all: Holm's correction multiplies p by the size of the family.
bool canReject(std::size_t pairs, std::size_t family) {
  return smallestP(pairs) * static_cast<double>(family) < kSignificance;
}

std::string verdictOf(const Json& winner, std::size_t pairs, std::size_t family) {
  if (!winner.is_null()) return winner.get<std::string>() + " is better";
  return canReject(pairs, family) ? "no difference shown" : kTooFewPairs;
}

using Pairing = std::pair<const Entry*, const Entry*>;

/// Every two methods.
std::vector<Pairing> pairingsOf(const Section& section) {
  std::vector<Pairing> pairings;
  for (auto a = section.entries.begin(); a != section.entries.end(); ++a) {
    for (auto b = a + 1; b != section.entries.end(); ++b) pairings.emplace_back(*a, *b);
  }
  return pairings;
}

/// Each method and the baseline. A single run of the method that is the baseline has none.
std::vector<Pairing> pairingsWithBaseline(const Section& section) {
  std::vector<Pairing> pairings;
  if (!section.baseline) return pairings;
  for (const Entry* entry : section.entries) {
    if (entry->method != kBaselineRun) pairings.emplace_back(entry, &*section.baseline);
  }
  return pairings;
}

void addFamily(const std::vector<Pairing>& pairings,
               const std::vector<const Selection*>& selections, Table& table) {
  std::vector<Comparison> family;
  std::vector<double> p_values;
  for (const Selection* selection : selections) {
    for (const auto& [a, b] : pairings) {
      const Comparison comparison = compare(*a, *b, *selection);
      if (comparison.pairs == 0) continue;
      family.push_back(comparison);
      p_values.push_back(comparison.test.p_value);
    }
  }
  const std::vector<double> corrected = pcrb::holmAdjusted(p_values);
  for (std::size_t i = 0; i < family.size(); ++i) {
    const Comparison& row = family[i];
    const Json winner = better(row, corrected[i]);
    const std::string verdict = verdictOf(winner, row.pairs, family.size());
    table.rows.push_back({row.a->method, row.b->method, row.selection->name, row.problems,
                          row.pairs, row.test.pseudomedian, row.test.p_value, corrected[i], winner,
                          verdict});
  }
}

/// Correlation of the error with a property of the problems that have it.
template <typename Property>
pcrb::Correlation correlate(const Problems& problems, bool answered_only,
                            const Property& property) {
  std::vector<double> x, y;
  for (const ScoredProblem* problem : problems) {
    const std::optional<double> value = property(*problem);
    if (!value || (answered_only && !problem->isAnswered())) continue;
    x.push_back(*value);
    y.push_back(problem->error);
  }
  return pcrb::spearman(x, y);
}

void appendCorrelations(const Problems& problems, bool answered_only, std::vector<Json>& row) {
  const auto misalignment = correlate(problems, answered_only, [](const ScoredProblem& problem) {
    return problem.initial_misalignment;
  });
  const auto overlap = correlate(problems, answered_only,
                                 [](const ScoredProblem& problem) { return problem.overlap; });
  row.emplace_back(std::max(misalignment.count, overlap.count));
  for (const auto& correlation : {misalignment, overlap}) {
    row.push_back(number(correlation.rho));
    row.push_back(number(correlation.p_value));
  }
}

}  // namespace

Table comparisonTable(const Section& section) {
  Table table{
      "comparisons",
      "Which differences are real",
      "Wilcoxon's signed-rank test on the problems that both methods have, pairs of clouds as "
      "units: a's median error of each minus b's; p corrected by Holm among the totals, and among "
      "all rows of single sequences; those against `do nothing` are families of their own. "
      "difference: Hodges and Lehmann's estimate, which belongs to "
      "this test: the median of the averages of all two pairs' differences.",
      {{"a"},
       {"b"},
       {"selection"},
       {"problems", Format::kCount},
       {"pairs", Format::kCount},
       {"difference", Format::kError},
       {"p", Format::kProbability},
       {"corrected p", Format::kProbability},
       {"better"},
       {"verdict"}},
      {}};
  for (const auto& pairings : {pairingsOf(section), pairingsWithBaseline(section)}) {
    addFamily(pairings, {section.at({"total"}).front()}, table);
    addFamily(pairings, section.at({"sequence"}), table);
  }
  return table;
}

Table correlationTable(const Section& section) {
  Table table{
      "correlations",
      "What the error depends on",
      "Spearman's rank correlation of the error with the initial misalignment and with the "
      "overlap. Look at single sequences first: overlaps are not comparable between data "
      "sets, and pooling hides their effect. 'answered' leaves out problems without a valid "
      "reply, whose error is their misalignment.",
      {{"method"}, {"selection"}},
      {}};
  for (const std::string suffix : {"", " (answered)"}) {
    table.columns.push_back({"n" + suffix, Format::kCount});
    for (const char* name : {"misalignment", "overlap"}) {
      table.columns.push_back({std::string("rho ") + name + suffix, Format::kFraction});
      table.columns.push_back({std::string("p ") + name + suffix, Format::kProbability});
    }
  }
  for (const Entry* entry : section.withBaseline()) {
    for (const Selection* selection : section.at({"sequence", "total"})) {
      const Problems problems = select(*entry, *selection);
      if (problems.empty()) continue;
      std::vector<Json> row{entry->method, selection->name};
      appendCorrelations(problems, false, row);
      appendCorrelations(problems, true, row);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace pcrb_tools
