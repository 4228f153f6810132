#pragma once

#include <cstdint>
#include <string>

#include "pcrb_server/playback/playback.hpp"

namespace pcrb_tools {

/// What both bag tools are asked for.
struct BagOptions {
  std::string output;     ///< the bag
  double period = 0.5;    ///< s from a scene to the next, > 0
  bool compress = false;  ///< LZ4
  bool force = false;     ///< replace an output that somebody else made
};

/// What `sequence_to_bag` is asked for.
struct SequenceBagOptions {
  BagOptions bag;
  pcrb::SequenceOptions sequence;
  std::string scans;        ///< file for score_poses: which scan has which stamp; empty = none
  bool keeps_time = false;  ///< scans are as far apart as the timestamps in their names, whatever
                            ///< the period
};

/// What `problems_to_bag` is asked for.
struct ProblemsBagOptions {
  BagOptions bag;
  pcrb::ProblemsOptions problems;  ///< its root, sequence and kind are those of the problem file,
                                   ///< its secret is drawn
  std::string problem_file;        ///< `<root>/<data set>/<sequence>_<kind>.txt`
  std::string key;                 ///< file of the key; empty = none
};

/// Writes what replay shows of a sequence as a bag. A bag that is complete and unchanged is kept.
///
/// @throws pcrb::Error  if the sequence or an output is not as it should be; to keep time, if the
///                      timestamps in the names do not increase, or a name has none.
void runSequenceBagTool(const SequenceBagOptions& options);

/// Writes what replay shows of a problem file as a bag, or, without truth, what a client of the
/// server would see, and the key to score the poses that come back.
///
/// @throws pcrb::Error  if the problems or an output are not as they should be.
/// @throws pcrb::InvalidParameter  if there is no key where one is needed to score.
void runProblemsBagTool(const ProblemsBagOptions& options);

/// Stamp of a bag's first message; the others follow by the period.
constexpr std::uint32_t kBagStart = 1000000000;  // s, in 2001

}  // namespace pcrb_tools
