#include "io/c_number.hpp"

#include <locale.h>
#include <strings.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace pcrb::c_number {
namespace {

constexpr int kSurelyKept = std::numeric_limits<double>::digits10;        // 15
constexpr int kSurelyEnough = std::numeric_limits<double>::max_digits10;  // 17

locale_t classicLocale() {
  static const locale_t locale = newlocale(LC_ALL_MASK, "C", nullptr);
  return locale;
}

/// The C locale for this thread, while it lives.
class ClassicLocale {
 public:
  ClassicLocale() : before_(uselocale(classicLocale())) {}
  ~ClassicLocale() { uselocale(before_); }
  ClassicLocale(const ClassicLocale&) = delete;
  ClassicLocale& operator=(const ClassicLocale&) = delete;

 private:
  locale_t before_;
};

std::string print(const char* format, int decimals, double value) {
  const ClassicLocale classic;
  std::array<char, 400> text{};  // room for the largest double and some decimals
  const int length = std::snprintf(text.data(), text.size(), format, decimals, value);
  if (static_cast<std::size_t>(length) < text.size()) {
    return {text.data(), static_cast<std::size_t>(length)};
  }
  std::string longer(static_cast<std::size_t>(length) + 1, '\0');
  std::snprintf(longer.data(), longer.size(), format, decimals, value);
  longer.pop_back();
  return longer;
}

double valueOf(const std::string& text) { return strtod_l(text.c_str(), nullptr, classicLocale()); }

const char* skipDigits(const char* text, const char* end) {
  while (text != end && *text >= '0' && *text <= '9') ++text;
  return text;
}

bool startsWith(const char* text, const char* end, const char* word) {
  const std::size_t length = std::strlen(word);
  return static_cast<std::size_t>(end - text) >= length && strncasecmp(text, word, length) == 0;
}

/// One past the word for an infinity or not-a-number, nullptr where there is none.
const char* skipWord(const char* text, const char* end) {
  for (const char* word : {"infinity", "inf"}) {
    if (startsWith(text, end, word)) return text + std::strlen(word);
  }
  if (!startsWith(text, end, "nan")) return nullptr;
  text += 3;
  const char* behind = text;
  if (behind == end || *behind++ != '(') return text;
  while (behind != end && (std::isalnum(static_cast<unsigned char>(*behind)) || *behind == '_'))
    ++behind;
  return behind != end && *behind == ')' ? behind + 1 : text;
}

/// One past digits with a point in or around them, nullptr where there is no digit.
const char* skipDecimal(const char* text, const char* end) {
  const char* behind = skipDigits(text, end);
  auto digits = behind - text;
  if (behind != end && *behind == '.') {
    const char* const decimals = behind + 1;
    behind = skipDigits(decimals, end);
    digits += behind - decimals;
  }
  return digits > 0 ? behind : nullptr;
}

/// One past an exponent, or `text` where there is none.
const char* skipExponent(const char* text, const char* end) {
  if (text == end || (*text != 'e' && *text != 'E')) return text;
  const char* digits = text + 1;
  if (digits != end && (*digits == '+' || *digits == '-')) ++digits;
  const char* const behind = skipDigits(digits, end);
  return behind == digits ? text : behind;
}

bool hasDigitBut0(const char* text, const char* end) {
  for (; text != end && *text != 'e' && *text != 'E'; ++text) {
    if (*text >= '1' && *text <= '9') return true;
  }
  return false;
}

/// d.ddde±xx of the value with so many digits.
std::string withDigits(double value, int digits) { return print("%.*e", digits - 1, value); }

/// The value's last digit moved by one, for a neighbour that is nearer to nothing but still reads
/// back: below a power of two doubles lie closer, so that the nearest text may be another double's.
std::string moved(const std::string& text, int step) {
  const std::size_t exponent = text.find('e');
  std::string digits = text.substr(0, exponent);
  for (std::size_t i = digits.size(); i-- > 0;) {
    if (digits[i] < '0' || digits[i] > '9') continue;
    const int digit = digits[i] - '0' + step;
    digits[i] = static_cast<char>('0' + (digit + 10) % 10);
    if (digit >= 0 && digit <= 9) return digits + text.substr(exponent);
  }
  return text;
}

/// Scientific notation with the fewest digits that read back to the same double, zeros at its end
/// aside. @param value  > 0.
std::string fewestDigits(double value) {
  // Doubles below the normal ones keep fewer digits.
  const bool is_normal = value >= std::numeric_limits<double>::min();
  for (int digits = is_normal ? kSurelyKept : 1; digits < kSurelyEnough; ++digits) {
    const std::string nearest = withDigits(value, digits);
    for (const std::string& text : {nearest, moved(nearest, 1), moved(nearest, -1)}) {
      if (valueOf(text) == value) return text;
    }
  }
  return withDigits(value, kSurelyEnough);
}

/// Digits without zeros at the end, and the power of ten of the first.
struct Digits {
  explicit Digits(const std::string& text) : exponent(std::atoi(&text[text.find('e') + 1])) {
    for (const char c : text.substr(0, text.find('e'))) {
      if (c >= '0' && c <= '9') digits += c;
    }
    digits.erase(digits.find_last_not_of('0') + 1);
  }

  int size() const { return static_cast<int>(digits.size()); }
  int lengthFixed() const {
    if (exponent < 0) return size() - exponent + 1;
    return size() > exponent + 1 ? size() + 1 : exponent + 1;
  }
  int lengthScientific() const {
    return size() + (size() > 1 ? 1 : 0) + (std::abs(exponent) < 100 ? 4 : 5);
  }

  std::string digits;
  int exponent;
};

}  // namespace

const char* scan(const char* begin, const char* end, double& value) {
  const char* const text = begin != end && *begin == '-' ? begin + 1 : begin;
  const char* behind = skipWord(text, end);
  const bool is_word = behind != nullptr;
  if (!is_word) {
    behind = skipDecimal(text, end);
    if (behind == nullptr) return nullptr;
    behind = skipExponent(behind, end);
  }
  const double parsed = valueOf(std::string(begin, behind));
  const bool too_large = !is_word && std::isinf(parsed);
  const bool too_small = !is_word && parsed == 0.0 && hasDigitBut0(text, behind);
  if (too_large || too_small) return nullptr;
  value = parsed;
  return behind;
}

std::string shortest(double value) {
  if (!std::isfinite(value) || value == 0.0) return fixed(value, 0);
  const Digits found(fewestDigits(std::abs(value)));
  if (found.lengthFixed() <= found.lengthScientific()) {
    const int decimals = found.size() - 1 - found.exponent;
    // The last digit may be one that is not the nearest: its text is made of the digits.
    if (decimals <= 0) return fixed(value, 0);
    std::string text = found.digits;
    if (found.exponent < 0) text.insert(0, static_cast<std::size_t>(-found.exponent), '0');
    text.insert(text.size() - static_cast<std::size_t>(decimals), 1, '.');
    return (value < 0.0 ? "-" : "") + text;
  }
  std::string text = found.digits;
  if (text.size() > 1) text.insert(1, 1, '.');
  std::array<char, 8> exponent{};
  std::snprintf(exponent.data(), exponent.size(), "e%+03d", found.exponent);
  return (value < 0.0 ? "-" : "") + text + exponent.data();
}

std::string fixed(double value, int decimals) { return print("%.*f", decimals, value); }

std::string scientific(double value, int decimals) { return print("%.*e", decimals, value); }

}  // namespace pcrb::c_number
