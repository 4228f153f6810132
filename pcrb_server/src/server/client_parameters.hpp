#pragma once

#include <string>

#include "pcrb_server/node_main.hpp"
#include "server/publications.hpp"
#include "server/run_record.hpp"

namespace pcrb {

/// Private parameters of a node as text, by name; empty where there are none.
std::string parametersOf(const std::string& node);

/// Compares the parameters of a run's client where every problem has its result, so that none will
/// be put to it; waits for it to listen, `limit` s at most.
/// @throws StoreError  if it came with other parameters.
void checkClientOfFinishedRun(RunRecord& record, const Publications& publications,
                              const ShutdownRequest& shutdown, double limit);

}  // namespace pcrb
