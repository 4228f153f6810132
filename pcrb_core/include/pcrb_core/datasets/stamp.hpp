#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pcrb {

/// Time since the epoch in ns. Never a double: at today's dates a double's step is 256 ns.
using Stamp = std::int64_t;

constexpr Stamp kSecond = 1'000'000'000;

/// The stamp in a file's name, `seconds[.fraction]`, exactly; nothing for any other text, for
/// signs, exponents, more than nine decimals other than zeros, and times beyond the year 2262.
std::optional<Stamp> parseStamp(std::string_view text);

/// The timestamp of a trajectory: any decimal number of seconds, also as `1.3e+09` or with twelve
/// decimals (as numpy.savetxt writes it), rounded to the nearest ns and never through a double.
/// @return  nothing for any other text, negative times, and times beyond the year 2262.
std::optional<Stamp> parseTimestamp(std::string_view text);

/// `seconds.nanoseconds` with nine decimals, as the clouds of TUM's sequences are named.
/// @param stamp  >= 0
std::string formatStamp(Stamp stamp);

/// The stamp nearest to a duration of seconds, e.g. a limit from the command line.
/// @throws InvalidParameter  if it is not finite, negative or over a hundred years.
Stamp toStamp(double seconds);

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
