#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pcrb_core/evaluation/rank_tests.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

constexpr double kAuditLevel = 0.01;  // corrected p below which a method is suspected
constexpr double kNoticeable = 0.1;   // of the audited error: an audit publishes fewer points
constexpr const char* kConsistent = "consistent";

/// One row of the table, before the correction of its p-value.
struct AuditCheck {
  std::string method;
  std::string check;
  std::size_t problems = 0;
  std::size_t pairs = 0;
  double protected_error = 0.0;  ///< median error where a memory is of no use
  double exposed_error = 0.0;    ///< and where it may be
  double p_value = 1.0;
  double smallest_p = 1.0;  ///< that so many pairs could give
  std::string gain;         ///< the verdict if the test rejects
};

double median(std::vector<double> values) { return pcrb::describe(std::move(values)).median; }

std::string errorWords(double error) { return cellText(number(error), Format::kError); }

/// Errors of each pair of clouds, in the order in which its problems were posed.
std::vector<std::vector<double>> errorsInOrder(const Entry& entry) {
  std::map<std::string, std::vector<const ScoredProblem*>> pairs;
  for (const ScoredProblem& problem : entry.problems) {
    if (problem.finished) pairs[problem.pair].push_back(&problem);
  }
  std::vector<std::vector<double>> groups;
  for (auto& [pair, problems] : pairs) {
    std::sort(problems.begin(), problems.end(),
              [](const auto* a, const auto* b) { return *a->finished < *b->finished; });
    if (problems.size() > 1) groups.push_back(errorsOf(problems));
  }
  return groups;
}

void addOrderCheck(const Entry& entry, std::vector<AuditCheck>& checks) {
  if (!entry.info || !entry.info->client) return;  // nobody was asked, so nobody could remember
  const auto groups = errorsInOrder(entry);
  if (groups.empty()) return;
  std::vector<double> firsts, later;
  for (const auto& group : groups) {
    firsts.push_back(group.front());
    later.insert(later.end(), group.begin() + 1, group.end());
  }
  const pcrb::OrderTest test = pcrb::firstAgainstLater(groups);
  AuditCheck check;
  check.method = entry.method;
  check.check = "first problem of a pair, later ones";
  check.problems = firsts.size() + later.size();
  check.pairs = test.groups;
  check.protected_error = median(firsts);
  check.exposed_error = median(later);
  check.p_value = test.p_value;
  check.smallest_p = test.smallest_p;
  check.gain = "gains by memory: " + errorWords(check.protected_error) +
               " on a pair's first problem, " + errorWords(check.exposed_error) + " on later ones";
  checks.push_back(check);
}

bool isAudited(const Entry& entry) { return entry.info->configuration.presentation.audit; }

/// Whether b is an audited run of what a is a plain one of.
bool isAuditOf(const Entry& b, const Entry& a) {
  if (!a.info || !b.info || isAudited(a) || !isAudited(b)) return false;
  const pcrb::RunConfiguration& plain = a.info->configuration;
  const pcrb::RunConfiguration& audited = b.info->configuration;
  return !plain.under_test.empty() && plain.under_test == audited.under_test &&
         plain.presentation.kind == audited.presentation.kind;
}

void addRunCheck(const Section& section, const Entry& plain, const Entry& audited,
                 std::vector<AuditCheck>& checks) {
  AuditCheck check;
  check.method = plain.method;
  check.check = "run without an audit, " + audited.method;
  const SharedErrors shared = sharedErrors(plain, audited, *section.at({"total"}).front());
  std::array<std::vector<double>, 2> medians;
  for (const auto& [pair, errors] : shared.by_pair) {
    for (std::size_t i : {0u, 1u}) medians[i].push_back(median(errors[i]));
  }
  check.problems = shared.problems;
  check.pairs = shared.by_pair.size();
  if (check.pairs == 0) return;
  std::vector<double> gains;
  for (std::size_t i = 0; i < check.pairs; ++i) gains.push_back(medians[1][i] - medians[0][i]);
  const pcrb::PairedTest test = pcrb::wilcoxon(gains);
  check.protected_error = median(medians[1]);
  check.exposed_error = median(medians[0]);
  const bool is_gain =
      test.positive > test.negative && test.pseudomedian > kNoticeable * check.protected_error;
  check.p_value = is_gain ? test.p_value : 1.0;
  check.smallest_p = smallestP(check.pairs);
  check.gain = "gains by memory: " + errorWords(check.exposed_error) + " without an audit, " +
               errorWords(check.protected_error) + " with one";
  checks.push_back(check);
}

std::string auditVerdict(const AuditCheck& check, double corrected_p, std::size_t family) {
  if (corrected_p < kAuditLevel) return check.gain;
  const bool can_reject = check.smallest_p * static_cast<double>(family) < kAuditLevel;
  return can_reject ? kConsistent : kTooFewPairs;
}

}  // namespace

Table auditTable(const Section& section) {
  std::vector<AuditCheck> checks;
  for (const Entry* entry : section.entries) {
    addOrderCheck(*entry, checks);
    for (const Entry* other : section.entries) {
      if (isAuditOf(*other, *entry)) addRunCheck(section, *entry, *other, checks);
    }
  }
  std::vector<double> p_values;
  for (const AuditCheck& check : checks) p_values.push_back(check.p_value);
  const std::vector<double> corrected = pcrb::holmAdjusted(p_values);
  Table table{
      "audit",
      "Does a memory help?",
      "A client that remembers clouds or solved pairs scores better than its method. First: "
      "of each pair of clouds the problem that was posed first against the later ones, "
      "whose order is secret and random (ranks within the pairs, exact). Second: a run "
      "without an audit against the audited run of the same problems (Wilcoxon's test over "
      "pairs of clouds; differences of less than a tenth are no gain). p is corrected by "
      "Holm; below 0.01 the verdict says what is gained.",
      {{"method"},
       {"compared"},
       {"problems", Format::kCount},
       {"pairs", Format::kCount},
       {"first or audited", Format::kError},
       {"later or plain", Format::kError},
       {"corrected p", Format::kProbability},
       {"verdict"}},
      {}};
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const AuditCheck& check = checks[i];
    table.rows.push_back({check.method, check.check, check.problems, check.pairs,
                          check.protected_error, check.exposed_error, corrected[i],
                          auditVerdict(check, corrected[i], checks.size())});
  }
  return table;
}

}  // namespace pcrb_tools
