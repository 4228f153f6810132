#include "report/scored_problem.hpp"

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/problem/problem_file.hpp"

namespace pcrb_tools {
namespace {

constexpr std::uint64_t kProblemsPerPair = 31;  // 30 local ones and a global one

/// What every official id of a sequence begins with.
std::string idPrefix(const std::string& sequence) {
  const std::string first = pcrb::problemId(sequence, 0, 1);  // … and the index of two digits
  return first.substr(0, first.size() - 2);
}

}  // namespace

std::string pairOf(const ScoredProblem& problem) {
  const std::string sequence = problem.key.data_set + "/" + problem.key.sequence + " ";
  if (!problem.source.empty()) return sequence + problem.source + " " + problem.target;
  const std::string& id = problem.key.problem_id;
  const std::string prefix = idPrefix(problem.key.sequence);
  if (id.size() > prefix.size() && id.compare(0, prefix.size(), prefix) == 0) {
    const auto index = pcrb::parseUnsigned(id.substr(prefix.size()));
    if (index) return sequence + "pair " + std::to_string(*index / kProblemsPerPair);
  }
  return sequence + "problem " + id;
}

}  // namespace pcrb_tools
