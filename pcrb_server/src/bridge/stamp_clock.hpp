#pragma once

#include <algorithm>
#include <cstdint>

namespace pcrb {

/// Every stamp that the bridge sends, ns: unique, strictly increasing, and none later than now.
///
/// Within a problem scans follow each other by the same spacing, however long the node takes to
/// answer: filters predict over the time between stamps.
class StampClock {
 public:
  /// @param is_even  false: scans are stamped with the time at which they are sent.
  explicit StampClock(bool is_even) : is_even_(is_even) {}

  /// A stamp for what is sent now.
  std::int64_t now(std::int64_t time) { return last_ = std::max(time, last_ + 1); }

  /// The stamp of a scan after the first one of its problem.
  /// @param time  now, at least `spacing` ns after the scan before was sent.
  std::int64_t next(std::int64_t time, std::int64_t spacing) {
    return last_ = is_even_ ? last_ + spacing : std::max(time, last_ + 1);
  }

 private:
  bool is_even_;
  std::int64_t last_ = 0;
};

}  // namespace pcrb
