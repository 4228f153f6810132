#pragma once

#include "pcrb_core/evaluation/result.hpp"

namespace pcrb {

/// Reason of a problem that localization_bridge, not the node under test, gave up as kFailed.
inline constexpr const char* kNodeLeft = "the node under test left while it had the problem";

/// Whether the node under test itself said something that could be taken: a valid reply, or that it
/// cannot.
bool isAnswered(const Result& result);

}  // namespace pcrb
