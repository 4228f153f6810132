#include "pcrb_core/datasets/stamp.hpp"

#include <cmath>
#include <limits>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kDecimals = 9;

bool onlyDigits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::optional<Stamp> parseStamp(std::string_view text) {
  const std::size_t point = text.find('.');
  const std::string_view seconds = text.substr(0, point);
  std::string_view fraction = point == std::string_view::npos ? "" : text.substr(point + 1);
  if (seconds.empty() || !onlyDigits(seconds) || !onlyDigits(fraction)) return std::nullopt;
  if (fraction.size() > kDecimals) {
    if (fraction.find_first_not_of('0', kDecimals) != std::string_view::npos) return std::nullopt;
    fraction = fraction.substr(0, kDecimals);
  }
  std::string nanoseconds(fraction);
  nanoseconds.resize(kDecimals, '0');
  const auto whole = parseInt(seconds);
  const auto part = parseInt(nanoseconds);
  if (!whole || !part || *whole > std::numeric_limits<Stamp>::max() / kSecond - 1) {
    return std::nullopt;
  }
  return *whole * kSecond + *part;
}

std::string formatStamp(Stamp stamp) {
  const std::string nanoseconds = std::to_string(stamp % kSecond);
  return std::to_string(stamp / kSecond) + '.' + std::string(kDecimals - nanoseconds.size(), '0') +
         nanoseconds;
}

Stamp toStamp(double seconds) {
  constexpr double kHundredYears = 3.2e9;
  if (!(seconds >= 0.0 && seconds < kHundredYears)) {
    throw InvalidParameter("found a duration of " + formatShortest(seconds) +
                           " s, expected 0 or more");
  }
  return std::llround(seconds * static_cast<double>(kSecond));
}

}  // namespace pcrb
