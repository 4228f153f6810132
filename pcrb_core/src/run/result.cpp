#include "pcrb_core/run/result.hpp"

#include <tuple>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr std::array<Outcome, 5> kOutcomes = {
    Outcome::kReplied, Outcome::kFailed, Outcome::kTimedOut, Outcome::kRejected, Outcome::kSkipped};

auto fields(const ProblemKey& key) {
  return std::tie(key.data_set, key.sequence, key.kind, key.problem_id);
}

}  // namespace

const char* toString(Outcome outcome) {
  switch (outcome) {
    case Outcome::kReplied:
      return "replied";
    case Outcome::kFailed:
      return "failed";
    case Outcome::kTimedOut:
      return "timed_out";
    case Outcome::kRejected:
      return "rejected";
    case Outcome::kSkipped:
      return "skipped";
  }
  throw InvalidParameter("outcome: found number " + std::to_string(static_cast<int>(outcome)) +
                         ", expected 0 to 4");
}

Outcome outcomeFromString(const std::string& text) {
  for (const Outcome outcome : kOutcomes) {
    if (text == toString(outcome)) return outcome;
  }
  throw InvalidParameter("outcome: found `" + text +
                         "`, expected replied, failed, timed_out, rejected or skipped");
}

std::string ProblemKey::subject() const {
  return data_set + "/" + sequence + " " + toString(kind) + " " + problem_id;
}

bool ProblemKey::operator<(const ProblemKey& other) const { return fields(*this) < fields(other); }

bool ProblemKey::operator==(const ProblemKey& other) const {
  return fields(*this) == fields(other);
}

bool isAnswered(const Result& result) {
  return result.outcome == Outcome::kReplied ||
         (result.outcome == Outcome::kFailed && result.reason != kNodeLeft);
}

}  // namespace pcrb
