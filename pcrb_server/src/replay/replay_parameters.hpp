#pragma once

#include <memory>
#include <string>

#include "pcrb_server/playback/playback.hpp"

namespace pcrb {

/// Parameters of `replay`: what is shown, and how.
struct ReplayParameters {
  enum class Subject { kSequence, kProblems, kRun };

  Subject subject = Subject::kSequence;
  SequenceOptions sequence;
  ProblemsOptions problems;
  RunOptions run;

  double rate = 2.0;  ///< scenes per second
  bool loop = false;
  bool autostart = true;
  bool keep_alive = false;  ///< after the last scene: stay, for whoever looks later
  std::string stamps_file;  ///< which scan was published when; empty = not written
};

/// Reads and checks all private parameters.
///
/// @throws InvalidParameter  listing every mistake.
ReplayParameters readReplayParameters();

std::unique_ptr<Playback> makePlayback(const ReplayParameters& parameters);

}  // namespace pcrb
