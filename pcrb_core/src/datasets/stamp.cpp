#include "pcrb_core/datasets/stamp.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

constexpr std::size_t kDecimals = 9;
constexpr std::int64_t kLargestExponent = 1000;

bool onlyDigits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// A number without sign and exponent: its digits from the first that is not 0 on, and how many of
/// them, or how many zeros before them if negative, are before the point.
struct Decimal {
  std::string digits;
  std::int64_t point = 0;
};

std::string_view withoutPlus(std::string_view text) {
  return startsWith(text, "+") ? text.substr(1) : text;
}

std::optional<Decimal> takeDecimal(std::string_view text) {
  text = withoutPlus(text);
  const std::size_t point = std::min(text.find('.'), text.size());
  Decimal decimal;
  decimal.digits = text.substr(0, point);
  if (point < text.size()) decimal.digits += text.substr(point + 1);
  if (decimal.digits.empty() || !onlyDigits(decimal.digits)) return std::nullopt;
  const std::size_t zeros = std::min(decimal.digits.find_first_not_of('0'), decimal.digits.size());
  decimal.digits.erase(0, zeros);
  decimal.point = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(zeros);
  return decimal;
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

std::optional<Stamp> parseTimestamp(std::string_view text) {
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  const auto decimal = takeDecimal(text.substr(0, e));
  const auto exponent =
      e == text.size() ? std::optional(std::int64_t{0}) : parseInt(withoutPlus(text.substr(e + 1)));
  const bool has_two_signs = text.find("+-", e) != std::string_view::npos;
  if (!decimal || !exponent || has_two_signs || std::abs(*exponent) > kLargestExponent)
    return std::nullopt;
  // The number of ns is the digits up to here, rounded.
  const std::int64_t wanted = decimal->point + *exponent + static_cast<std::int64_t>(kDecimals);
  if (decimal->digits.empty() || wanted < 0) return 0;
  const auto whole = static_cast<std::size_t>(wanted);
  std::string digits = decimal->digits.substr(0, whole);
  digits.resize(whole, '0');
  const auto stamp = digits.empty() ? std::optional(std::int64_t{0}) : parseInt(digits);
  if (!stamp || *stamp > std::numeric_limits<Stamp>::max() - kSecond) return std::nullopt;
  return *stamp + (whole < decimal->digits.size() && decimal->digits[whole] >= '5' ? 1 : 0);
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
