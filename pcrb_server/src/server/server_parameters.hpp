#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb {

/// Parameters of `benchmark_server`; the README's table says what each means.
struct ServerParameters {
  std::string root;
  std::string run;
  std::string under_test;              ///< name of what is benchmarked; empty = not told
  std::vector<std::string> sequences;  ///< `all`, sequences, data_set/sequence, or data sets
  std::vector<Kind> kinds;
  PresentationKind presentation = PresentationKind::kRegistration;
  int subset = 0;  ///< 0 = all problems
  int shard = 0;
  int shards = 1;
  int seed = 1;
  double time_limit = 10.0;     ///< s
  bool handshake = true;        ///< wait for `ready` before a source is published
  double connect_limit = 60.0;  ///< s until the first client shows up
  double ready_limit = 60.0;    ///< s from a problem's announcement to `ready`
  bool global_guess = false;
  bool upright = false;
  bool debug = false;
  bool autostart = true;
  double linger = 5.0;  ///< s that the summary stays up at the end, unless its readers have left
  std::size_t cache_bytes = std::size_t{512} << 20;
  int load_threads = 1;
  std::string map_frame;
  std::string scan_frame;
  bool publish_tf = true;

  bool isLocalization() const { return presentation == PresentationKind::kLocalization; }

  /// Frame of the source as it is handed out.
  const std::string& sourceFrame() const { return isLocalization() ? scan_frame : map_frame; }
};

/// Reads and checks all private parameters.
///
/// @throws InvalidParameter  listing every mistake.
ServerParameters readServerParameters();

/// Where the results go, and which problems they are of, in two lines.
std::string describe(const ServerParameters& parameters);

/// What must be the same when a run is resumed: name and value of each such parameter.
std::map<std::string, std::string> configuration(const ServerParameters& parameters);

}  // namespace pcrb
