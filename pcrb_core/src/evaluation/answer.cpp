#include "pcrb_core/evaluation/answer.hpp"

namespace pcrb {

bool isAnswered(const Result& result) {
  return result.outcome == Outcome::kReplied ||
         (result.outcome == Outcome::kFailed && result.reason != kNodeLeft);
}

}  // namespace pcrb
