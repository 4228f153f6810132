#include "pcrb_core/io/number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "io/c_number.hpp"

#if defined(__cpp_lib_to_chars) && __cpp_lib_to_chars >= 201611L
#define PCRB_STANDARD_CONVERTS_DOUBLES
#endif

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

/// Any notation, correctly rounded.
const char* scanAnyDouble(const char* begin, const char* end, double& value) noexcept {
  // from_chars knows no plus sign; "+-1" must not become a number here.
  if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
#ifdef PCRB_STANDARD_CONVERTS_DOUBLES
  double parsed = 0.0;
  const auto result = std::from_chars(begin, end, parsed);
  if (result.ec != std::errc()) return nullptr;
  value = parsed;
  return result.ptr;
#else
  return c_number::scan(begin, end, value);
#endif
}

/// The shortest text; kLongestNumber characters are free at `out`.
char* writeAnyDouble(char* out, double value) noexcept {
#ifdef PCRB_STANDARD_CONVERTS_DOUBLES
  return std::to_chars(out, out + kLongestNumber, value).ptr;
#else
  const std::string text = c_number::shortest(value);
  return std::copy(text.begin(), text.end(), out);
#endif
}

// What follows reads plain decimals, nearly all numbers of point clouds, in 2/3 of the time of
// std::from_chars (docs/benchmarks.md): eight digits at a time, then w / 10^k by a multiplication
// that knows its error. Whatever is not plain, or too close to a tie to be sure, is left to
// from_chars, so that the result is the same.

__extension__ typedef unsigned __int128 Uint128;

constexpr int kMaxDigits = 19;  // of a number that fits in 64 bits
constexpr bool kIsLittleEndian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
constexpr std::uint64_t kZeros = 0x3030303030303030;  // eight '0'

/// Bytes from a number's start that the fast path may read: sign, up to 7 digits, point, two blocks
/// of 8 digits, and a third block that it only looks at.
constexpr std::ptrdiff_t kLongestRead = 1 + 7 + 1 + 16 + 8;

constexpr std::array<std::uint64_t, kMaxDigits + 1> makePowersOfTen() {
  std::array<std::uint64_t, kMaxDigits + 1> powers{1};
  for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = 10 * powers[k - 1];
  return powers;
}
constexpr auto kPowersOfTen = makePowersOfTen();

/// 1 / 10^k = (mantissa + e) * 2^(shift - 126) with 0 <= e < 1.
struct Reciprocal {
  std::uint64_t mantissa = 0;  // between 2^62 and 2^63
  int shift = 0;
};

constexpr std::array<Reciprocal, kMaxDigits + 1> makeReciprocals() {
  std::array<Reciprocal, kMaxDigits + 1> reciprocals{};
  for (std::size_t k = 0; k < reciprocals.size(); ++k) {
    std::uint64_t divisor = kPowersOfTen[k];
    for (; divisor >> 63 == 0; divisor <<= 1) ++reciprocals[k].shift;
    reciprocals[k].mantissa = static_cast<std::uint64_t>((Uint128{1} << 126) / divisor);
  }
  return reciprocals;
}
constexpr auto kReciprocals = makeReciprocals();

/// Eight bytes with the digits as 0 … 9, the first in the lowest byte, and how many of them, from
/// the first on, are digits.
struct Block {
  std::uint64_t bytes;
  int digits;
};

Block loadBlock(const char* text) noexcept {
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, text, sizeof(bytes));
  bytes ^= kZeros;
  // A byte that is no digit sets its top bit; what a carry does to later bytes does not matter.
  const std::uint64_t others = ((bytes + 0x7676767676767676) | bytes) & 0x8080808080808080;
  return {bytes, others == 0 ? 8 : __builtin_ctzll(others) / 8};
}

/// The number that eight digits are.
std::uint64_t valueOfEight(std::uint64_t bytes) noexcept {
  bytes = bytes * 10 + (bytes >> 8);  // pairs
  const std::uint64_t mask = 0x000000ff000000ff;
  return ((bytes & mask) * 0x000f424000000064 + ((bytes >> 16) & mask) * 0x0000271000000001) >> 32;
}

/// The number that the block's 1 to 8 digits are: zeros are moved in before them.
std::uint64_t valueOf(const Block& block) noexcept {
  return valueOfEight(block.bytes << (64 - 8 * block.digits));
}

/// The double nearest to ± w / 10^k, if rounding is certain; w = 0 never is.
bool divideByPowerOfTen(std::uint64_t w, int k, bool is_negative, double& value) noexcept {
  const int zeros = __builtin_clzll(w | 1);
  const Reciprocal& reciprocal = kReciprocals[static_cast<std::size_t>(k)];
  // The true quotient is between low and low + 2, times a power of two: cutting off loses less.
  const Uint128 product = static_cast<Uint128>(w << zeros) * reciprocal.mantissa;
  const auto low = static_cast<std::int64_t>(product >> 64);
  const auto rounded = static_cast<double>(low);
  if (rounded != static_cast<double>(low + 2)) return false;
  const auto exponent = static_cast<std::uint64_t>(1023 - 62 + reciprocal.shift - zeros);
  // The sign without a branch: half of all predictions would be wrong.
  const std::uint64_t bits = exponent << 52 | static_cast<std::uint64_t>(is_negative) << 63;
  double signed_power_of_two = 0.0;
  std::memcpy(&signed_power_of_two, &bits, sizeof(bits));
  value = rounded * signed_power_of_two;
  return true;
}

/// A plain decimal of at most 19 digits, 7 of them before the point; else nullptr.
const char* scanPlainDouble(const char* text, double& value) noexcept {
  const bool is_negative = *text == '-';
  text += is_negative;
  Block block = loadBlock(text);
  if (block.digits == 0 || block.digits == 8) return nullptr;
  std::uint64_t w = valueOf(block);
  int digits = block.digits;
  text += block.digits;
  int decimals = 0;
  if (*text == '.') {
    block = loadBlock(++text);
    for (; block.digits == 8; block = loadBlock(text)) {
      if (decimals == 16) return nullptr;
      w = w * kPowersOfTen[8] + valueOfEight(block.bytes);
      decimals += 8;
      text += 8;
    }
    if (block.digits > 0) {
      w = w * kPowersOfTen[static_cast<std::size_t>(block.digits)] + valueOf(block);
      decimals += block.digits;
      text += block.digits;
    }
    digits += decimals;
  }
  if (digits > kMaxDigits || (*text | 0x20) == 'e') return nullptr;
  return divideByPowerOfTen(w, decimals, is_negative, value) ? text : nullptr;
}

// What sensors' software writes has six decimals at most; such numbers are found and written in a
// quarter of the time of std::to_chars. Two decimals of at most 15 digits are never the same
// double, so one that is equal to the value is the shortest, but for its zeros at the end.

constexpr int kMicroDigits = 6;
constexpr std::uint64_t kMicro = 1000000;

/// Writes a number of at most six decimals; nullptr, and nothing of use in `out`, if it is none or
/// if scientific notation may be shorter.
char* writeMicros(char* out, double value) noexcept {
  const double magnitude = std::abs(value);
  if (!(magnitude >= 0.001 && magnitude < 100000.0)) return nullptr;
  const auto micros = static_cast<std::uint64_t>(magnitude * static_cast<double>(kMicro) + 0.5);
  if (static_cast<double>(micros) / static_cast<double>(kMicro) != magnitude) return nullptr;
  if (value < 0.0) *out++ = '-';
  out = std::to_chars(out, out + kLongestNumber - 1, micros / kMicro).ptr;
  std::uint64_t decimals = micros % kMicro;
  if (decimals == 0) return out;
  *out = '.';
  for (int i = kMicroDigits; i > 0; --i, decimals /= 10) {
    out[i] = static_cast<char>('0' + decimals % 10);
  }
  out += kMicroDigits;
  while (*out == '0') --out;
  return out + 1;
}

}  // namespace

const char* scanDouble(const char* begin, const char* end, double& value) noexcept {
  if (kIsLittleEndian && end - begin > kLongestRead) {
    const char* const behind = scanPlainDouble(begin, value);
    if (behind != nullptr) return behind;
  }
  return scanAnyDouble(begin, end, value);
}

std::optional<double> parseDouble(std::string_view text) noexcept {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  // An empty text may have no data: its end is the null pointer that stands for no number.
  if (text.empty() || scanDouble(text.data(), end, value) != end) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parseInt(std::string_view text) noexcept {
  return parseWhole<std::int64_t>(text);
}

std::optional<std::uint64_t> parseUnsigned(std::string_view text) noexcept {
  return parseWhole<std::uint64_t>(text);
}

char* writeShortest(char* out, double value) noexcept {
  char* const behind = writeMicros(out, value);
  return behind != nullptr ? behind : writeAnyDouble(out, value);
}

void appendShortest(std::string& text, double value) {
  char digits[kLongestNumber];  // the longest is -2.2250738585072014e-308
  text.append(digits, writeShortest(digits, value));
}

std::string formatShortest(double value) {
  std::string text;
  appendShortest(text, value);
  return text;
}

void appendFixed(std::string& text, double value, int decimals) {
  text += c_number::fixed(value, decimals);
}

std::string formatFixed(double value, int decimals) { return c_number::fixed(value, decimals); }

std::string formatScientific(double value, int decimals) {
  return c_number::scientific(value, decimals);
}

}  // namespace pcrb
