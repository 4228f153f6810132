#pragma once

#include "pcrb_core/evaluation/result.hpp"
#include "server/problem_poser.hpp"
#include "server/reply.hpp"

namespace pcrb {

/// The row of a problem, finished now: the same bits for the same pose, online and offline. Without
/// a pose the initial guess is scored.
Result scoreReply(const PosedProblem& posed, const Reply& reply);

/// The pose that a row was scored with: the accepted one, or without one the initial guess.
Transform scoredPose(const PosedProblem& posed, const Result& result);

}  // namespace pcrb
