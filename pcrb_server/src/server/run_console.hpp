#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "server/server_parameters.hpp"

namespace pcrb {

/// Where the results go, and which problems they are of, in two lines.
std::string describe(const ServerParameters& parameters);

/// What a run says in the end: its table, where its results are, and how to go on where problems
/// are left.
std::string describeEnd(const ServerParameters& parameters, const std::string& table,
                        std::size_t done, std::size_t total);

/// A line for each thing that speaks against a run.
///
/// @param foreign_replies  of nodes that were not the client.
/// @param skipped          problems that count against the run.
std::string describeDoubts(std::uint64_t foreign_replies, std::size_t skipped);

/// Says now and then on standard output how far a run is: never with names that a client must not
/// see.
class RunProgress {
 public:
  /// @param done  problems that earlier sessions finished; they do not count for the rate.
  RunProgress(std::size_t done, std::size_t total);

  /// One more problem is done.
  void add();

 private:
  using Clock = std::chrono::steady_clock;

  std::size_t before_;
  std::size_t done_;
  std::size_t total_;
  Clock::time_point start_;
  Clock::time_point shown_;
};

/// E.g. `37/60 problems (61 %), 12.3 problems/s, 2 s left`.
std::string formatRunProgress(std::size_t done, std::size_t total, std::size_t done_now,
                              double elapsed_s);

}  // namespace pcrb
