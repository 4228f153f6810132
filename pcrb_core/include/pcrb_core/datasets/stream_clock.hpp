#pragma once

#include <algorithm>
#include <optional>

#include "pcrb_core/datasets/stamp.hpp"

namespace pcrb {

/// Notices when the stamps of a stream go back because its log is played again, from the start or
/// from anywhere.
class StreamClock {
 public:
  /// Whether the stream goes back to this stamp: further than any disorder within one playing.
  bool goesBack(Stamp stamp) {
    const bool back = latest_ && *latest_ - stamp > kDisorder;
    latest_ = back || !latest_ ? stamp : std::max(*latest_, stamp);
    return back;
  }

  bool hasStarted() const { return latest_.has_value(); }

 private:
  static constexpr Stamp kDisorder = kSecond;

  std::optional<Stamp> latest_;
};

}  // namespace pcrb
