#include "server/scoring.hpp"

#include <chrono>

namespace pcrb {

namespace {

double secondsSinceEpoch() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

Result scoreReply(const PosedProblem& posed, const Reply& reply) {
  const PlannedProblem& planned = *posed.planned;
  const Metric& metric = *posed.source->metric;
  Result result;
  result.key = planned.key;
  result.source = planned.problem.source;
  result.target = planned.problem.target;
  result.overlap = planned.problem.overlap;
  result.outcome = reply.outcome;
  result.reason = reply.reason;
  result.initial_misalignment = posed.initial.error;
  PoseError error = posed.initial;  // of the initial guess: what a problem without a reply gets
  if (reply.outcome == Outcome::kReplied) {
    result.position = reply.position;
    result.orientation = reply.orientation;
    result.covariance = reply.covariance;
    error = metric.evaluate(
        posed.presentation.residual(makeTransform(reply.position, reply.orientation)));
  }
  result.error = error.error;
  result.rotation_error = error.rotation_error;
  result.translation_error = error.translation_error;
  result.runtime = reply.runtime;
  result.solver_time = reply.solver_time;
  result.scans_used = reply.scans_used;
  result.target_changed = planned.target_changed;
  result.replies_rejected = reply.rejected;
  result.finished = secondsSinceEpoch();
  return result;
}

Transform scoredPose(const PosedProblem& posed, const Result& result) {
  return result.position && result.orientation
             ? makeTransform(*result.position, *result.orientation)
             : posed.presentation.guess;
}

}  // namespace pcrb
