#pragma once

#include <cstddef>
#include <string>

#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/run/run_info.hpp"
#include "pcrb_server/parameter_table.hpp"
#include "ros/problem_messages.hpp"

namespace pcrb {

/// Parameters of `benchmark_server`.
struct ServerParameters {
  std::string run;                 ///< folder of the results
  RunConfiguration configuration;  ///< which problems, and how they are put to the client
  ProblemFrames frames;
  LoadOptions loading;
  double connect_limit = 60.0;     ///< s until the first client shows up
  double ready_limit = 60.0;       ///< s from a problem's announcement to `ready`
  double summary_hold_time = 5.0;  ///< s that the summary stays up, unless its readers have left
  bool allow_skipped = false;      ///< whether a run with skipped problems is a success
  bool autostart = true;
  bool publish_tf = true;
};

extern const ParameterTable kServerParameters;

/// Reads and checks all private parameters.
///
/// @throws InvalidParameter  listing every mistake.
ServerParameters readServerParameters();

}  // namespace pcrb
