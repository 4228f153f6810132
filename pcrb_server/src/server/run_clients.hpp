#pragma once

#include <set>
#include <string>

#include "pcrb_core/run/run_record.hpp"
#include "pcrb_server/node_main.hpp"
#include "server/problem_session.hpp"
#include "server/publications.hpp"
#include "server/server_parameters.hpp"

namespace pcrb {

/// Private parameters of a node as text, by name; empty where there are none.
std::string parametersOf(const std::string& node);

/// Waits for the clients of a run, and records which nodes they are and how they are set up.
class RunClients {
 public:
  /// All are kept by reference.
  RunClients(const ServerParameters& parameters, ProblemSession& session,
             const Publications& publications, const ShutdownRequest& shutdown, RunRecord& record);

  /// Waits until the problem may be served: with a handshake for `ready`, which must follow the
  /// announcement.
  ///
  /// @return  false where the run has to end.
  /// @throws Error  if no client comes within its limit.
  bool waitForReady();

  /// Without a handshake: waits for a subscriber of `problem`, before the announcement.
  /// @throws Error  if none comes within ~connect_limit.
  void waitForSubscriber();

  /// Compares the parameters of a run's client where every problem has its result, so that none
  /// will be put to it; waits for it to listen, ~summary_hold_time at most.
  /// @throws StoreError  if it came with other parameters.
  void checkThoseOfFinishedRun();

 private:
  void note(const std::set<std::string>& names);
  [[noreturn]] void giveUp(double limit, bool is_first) const;

  const ServerParameters& parameters_;
  ProblemSession& session_;
  const Publications& publications_;
  const ShutdownRequest& shutdown_;
  RunRecord& record_;
  std::set<std::string> noted_;
};

}  // namespace pcrb
