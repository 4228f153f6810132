#pragma once

#include "pcrb_core/error.hpp"

namespace pcrb_tools {

/// The user's wish to stop, as an exception: temporary files are cleared on its way out.
class Interrupted : public pcrb::Error {
 public:
  Interrupted()
      : Error("interrupted; what is complete is kept and the next run goes on from there") {}
};

/// While it lives, SIGINT and SIGTERM only set a flag; a second signal ends the process at once.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// @throws Interrupted  once a signal has come.
  static void check();
};

}  // namespace pcrb_tools
