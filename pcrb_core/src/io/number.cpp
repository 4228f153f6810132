#include "pcrb_core/io/number.hpp"

#include <charconv>
#include <limits>

namespace pcrb {
namespace {

template <typename Integer>
std::optional<Integer> parseWhole(std::string_view text) noexcept {
  Integer value{};
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

}  // namespace

const char* scanDouble(const char* begin, const char* end, double& value) noexcept {
  // from_chars knows no plus sign; "+-1" must not become a number here.
  if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
  double parsed = 0.0;
  const auto result = std::from_chars(begin, end, parsed);
  if (result.ec != std::errc()) return nullptr;
  value = parsed;
  return result.ptr;
}

std::optional<double> parseDouble(std::string_view text) noexcept {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  if (scanDouble(text.data(), end, value) != end) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parseInt(std::string_view text) noexcept {
  return parseWhole<std::int64_t>(text);
}

std::optional<std::uint64_t> parseUnsigned(std::string_view text) noexcept {
  return parseWhole<std::uint64_t>(text);
}

void appendShortest(std::string& text, double value) {
  char digits[32];  // the longest is -2.2250738585072014e-308
  const auto result = std::to_chars(digits, digits + sizeof(digits), value);
  text.append(digits, result.ptr);
}

std::string formatShortest(double value) {
  std::string text;
  appendShortest(text, value);
  return text;
}

void appendFixed(std::string& text, double value, int decimals) {
  const std::size_t start = text.size();
  // Room for the sign, all integer digits of the largest double and the point.
  text.resize(start + std::numeric_limits<double>::max_exponent10 + 3 +
              static_cast<std::size_t>(decimals));
  char* const first = text.data() + start;
  const auto result =
      std::to_chars(first, text.data() + text.size(), value, std::chars_format::fixed, decimals);
  text.resize(static_cast<std::size_t>(result.ptr - text.data()));
}

std::string formatFixed(double value, int decimals) {
  std::string text;
  appendFixed(text, value, decimals);
  return text;
}

std::string formatScientific(double value, int decimals) {
  std::string text(16 + static_cast<std::size_t>(decimals), '\0');  // sign, digit, point, e-308
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value,
                                    std::chars_format::scientific, decimals);
  text.resize(static_cast<std::size_t>(result.ptr - text.data()));
  return text;
}

}  // namespace pcrb
