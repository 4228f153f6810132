#pragma once

#include <limits>
#include <vector>

#include "pcrb_core/evaluation/distributions.hpp"
#include "report/section.hpp"

namespace pcrb_tools {

inline std::vector<pcrb::ProblemOutcome> attemptsOf(const Problems& problems) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  std::vector<pcrb::ProblemOutcome> attempts;
  for (const ScoredProblem* problem : problems) {
    attempts.push_back({problem->isAnswered(), problem->error,
                        problem->rotation_error.value_or(kNaN),
                        problem->translation_error.value_or(kNaN)});
  }
  return attempts;
}

}  // namespace pcrb_tools
