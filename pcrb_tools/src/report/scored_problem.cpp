#include "report/scored_problem.hpp"

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {
namespace {

constexpr std::uint64_t kProblemsPerPair = 31;  // 30 local ones and a global one
constexpr std::size_t kPublishedDigits = 4;     // of 31 · 100 - 1 and of 31 · 102 - 1

/// The digits of an official id that follow those of its sequence; empty if it is none.
std::string indexOf(const pcrb::ProblemKey& key) {
  const std::string first = pcrb::problemId(key.sequence, 0, 1);  // with an index of two digits
  const std::string prefix = first.substr(0, first.size() - 2);
  return key.problem_id.compare(0, prefix.size(), prefix) == 0
             ? key.problem_id.substr(prefix.size())
             : std::string();
}

}  // namespace

std::string pairOf(const ScoredProblem& problem) {
  const std::string sequence = problem.key.data_set + "/" + problem.key.sequence + " ";
  if (!problem.source.empty()) return sequence + problem.source + " " + problem.target;
  const auto index = pcrb::parseUnsigned(indexOf(problem.key));
  if (index) return sequence + "pair " + std::to_string(*index / kProblemsPerPair);
  return sequence + "problem " + problem.key.problem_id;
}

bool hasPublishedId(const pcrb::ProblemKey& key) {
  const std::string index = indexOf(key);
  return index.size() == kPublishedDigits && pcrb::parseUnsigned(index);
}

}  // namespace pcrb_tools
