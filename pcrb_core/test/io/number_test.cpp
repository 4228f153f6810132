#include "pcrb_core/io/number.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>

#include "io/c_number.hpp"

namespace pcrb {
namespace {

/// The representation, which tells -0 from 0.
std::uint64_t bitsOf(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

TEST(Number, ReadsEveryDecimalNotation) {
  EXPECT_EQ(parseDouble("8045123.123456789"), 8045123.123456789);
  EXPECT_EQ(parseDouble("-1.5e-3"), -0.0015);
  EXPECT_EQ(parseDouble("+2"), 2.0);
  EXPECT_EQ(parseDouble("1E2"), 100.0);
  EXPECT_EQ(parseDouble(".5"), 0.5);
  EXPECT_EQ(parseDouble("5."), 5.0);
  EXPECT_TRUE(std::isnan(*parseDouble("nan")));
  EXPECT_TRUE(std::isnan(*parseDouble("-NaN")));
  EXPECT_EQ(parseDouble("-inf"), -std::numeric_limits<double>::infinity());
}

TEST(Number, RejectsWhatIsNoNumberOrMoreThanANumber) {
  EXPECT_FALSE(parseDouble(std::string_view{})) << "empty, without data";
  for (const char* text : {"", "-", "+", ".", "abc", "1.5f", "1,5", "0x10", "1 ", " 1", "+-1",
                           "--1", "1e", "++1", "1.2.3"}) {
    EXPECT_FALSE(parseDouble(text)) << text;
  }
}

TEST(Number, RejectsWhatDoubleCannotHold) {
  EXPECT_FALSE(parseDouble("1e400"));
  EXPECT_FALSE(parseDouble("-1e400"));
  EXPECT_FALSE(parseUnsigned("18446744073709551616"));
  EXPECT_FALSE(parseInt("9223372036854775808"));
}

TEST(Number, IntegersAreWholeTexts) {
  EXPECT_EQ(parseInt("-12"), -12);
  EXPECT_EQ(parseUnsigned("18446744073709551615"), 18446744073709551615u);
  for (const char* text : {"", "1.0", "1 ", "1e3", "-"}) EXPECT_FALSE(parseInt(text)) << text;
  EXPECT_FALSE(parseUnsigned("-1"));
}

TEST(Number, ShortestTextReadsBackToTheSameBits) {
  std::mt19937_64 bits(7);
  for (int i = 0; i < 100000; ++i) {
    const std::uint64_t pattern = bits();
    double value = 0.0;
    std::memcpy(&value, &pattern, sizeof(value));
    if (!std::isfinite(value)) continue;
    const auto back = parseDouble(formatShortest(value));
    ASSERT_TRUE(back) << formatShortest(value);
    ASSERT_EQ(bitsOf(*back), pattern) << formatShortest(value);
  }
  EXPECT_EQ(formatShortest(0.1), "0.1");
  EXPECT_EQ(formatShortest(8045123.123456789), "8045123.123456789");
}

#if defined(__cpp_lib_to_chars) && __cpp_lib_to_chars >= 201611L
std::string standardShortest(double value) {
  char digits[64];
  return {digits, std::to_chars(digits, digits + 64, value).ptr};
}

/// As std::from_chars: one past the number, nullptr where there is none.
const char* standardScan(const char* begin, const char* end, double& value) {
  const auto result = std::from_chars(begin, end, value);
  return result.ec == std::errc() ? result.ptr : nullptr;
}

void expectCLibraryAgrees(double value) {
  const std::string expected = standardShortest(value);
  ASSERT_EQ(c_number::shortest(value), expected);
  double back = 0.0;
  const char* const end = expected.data() + expected.size();
  ASSERT_EQ(c_number::scan(expected.data(), end, back), end) << expected;
  ASSERT_EQ(bitsOf(back), bitsOf(value)) << expected;
}

TEST(CNumber, AgreesWithTheStandardLibraryToTheBit) {
  std::mt19937_64 bits(15);
  for (int i = 0; i < 50000; ++i) {
    const std::uint64_t pattern = bits();
    double value = 0.0;
    std::memcpy(&value, &pattern, sizeof(value));
    if (std::isfinite(value)) expectCLibraryAgrees(value);
    expectCLibraryAgrees(static_cast<double>(pattern >> (20 + i % 44)) / 1e6);
  }
  for (int exponent = -1074; exponent < 1024; ++exponent) {  // where gaps between doubles change
    const double value = std::ldexp(1.0, exponent);
    for (const double near : {value, -value, std::nextafter(value, 0.0)})
      expectCLibraryAgrees(near);
  }
}

TEST(CNumber, StopsWhereTheStandardLibraryStops) {
  for (const std::string text :
       {"",         "-",    "1e400",   "1e-400", "4e-324", "2e-324", "0e500",
        "-0",       "nan",  "NaN(12)", "nan(",   "-nan",   "inf",    "infinit",
        "INFINITY", "1e",   "1e+",     "1e+5x",  ".5",     "5.",     ".",
        "-.e3",     "0x10", "1.5f",    "00012",  "1e0005", "+1",     "1.7976931348623159e308",
        "-1e400"}) {
    double value = 0.0, expected = 0.0;
    const char* const end = text.data() + text.size();
    EXPECT_EQ(c_number::scan(text.data(), end, value), standardScan(text.data(), end, expected))
        << text;
    EXPECT_EQ(std::isnan(value), std::isnan(expected)) << text;
    if (!std::isnan(expected)) {
      EXPECT_EQ(bitsOf(value), bitsOf(expected)) << text;
    }
  }
}
#else  // the C library is what the numbers below are held against
std::string standardShortest(double value) { return c_number::shortest(value); }
const char* standardScan(const char* begin, const char* end, double& value) {
  return c_number::scan(begin, end, value);
}
#endif

TEST(Number, ShortestTextIsThatOfToChars) {
  const auto expect_like_to_chars = [](double value) {
    ASSERT_EQ(formatShortest(value), standardShortest(value));
  };
  for (const double value :
       {0.0,      -0.0,      1.0,     -1.5,    0.001,     0.0009999,    0.001001,
        1e-6,     9999.0,    10000.0, 12000.0, 99999.0,   99999.999999, 100000.0,
        100000.5, 1234567.0, 1e300,   5e-324,  0.1 + 0.2, 0.3,          4.35}) {
    expect_like_to_chars(value);
    expect_like_to_chars(-value);
  }
  std::mt19937_64 bits(9);
  for (int i = 0; i < 300000; ++i) {
    const auto whole = static_cast<double>(bits() >> (20 + bits() % 44));
    for (const double divisor : {1.0, 100.0, 1e6, 1e7}) {
      expect_like_to_chars(whole / divisor);
      expect_like_to_chars(std::nextafter(whole / divisor, 0.0));
    }
  }
}

/// Scans a number that stands in a longer text, where the fast path is open.
void expectScansLikeFromChars(const std::string& number) {
  const std::string text = number + " " + std::string(40, '7');
  double expected = 0.0;
  const char* const expected_behind =
      standardScan(text.data(), text.data() + text.size(), expected);
  ASSERT_NE(expected_behind, nullptr) << number;
  double value = 0.0;
  const char* const behind = scanDouble(text.data(), text.data() + text.size(), value);
  ASSERT_EQ(behind, expected_behind) << number;
  ASSERT_EQ(bitsOf(value), bitsOf(expected)) << number;
}

TEST(Number, ScanningALongTextGivesTheNearestDouble) {
  for (const char* number : {"0",
                             "-0",
                             "-0.0",
                             "5.",
                             "-.5",
                             ".25",
                             "1e5",
                             "1.5E-7",
                             "0.1234567",
                             "0.12345678",
                             "0.123456789012345",
                             "0.1234567890123456",
                             "0.12345678901234567",
                             "1.234567890123456789",
                             "0.0000000000000000001",
                             "0.00000000000000000001",
                             "1234567",
                             "12345678",
                             "-7654321.5",
                             "8045123.123456789",
                             "9007199254740993",
                             "9999999.999999999999",
                             "1234567.8901234567890",
                             "1.0x",
                             "0x10",
                             "1.2.3",
                             "nan",
                             "-inf"}) {
    expectScansLikeFromChars(number);
  }
}

TEST(Number, ScanningRandomDecimalsGivesTheNearestDouble) {
  std::mt19937_64 bits(11);
  for (int i = 0; i < 200000; ++i) {
    const double magnitude = std::ldexp(static_cast<double>(bits() >> 11), -53);
    const double value = (i % 2 == 0 ? 1.0 : -1.0) * magnitude * std::pow(10.0, bits() % 8);
    expectScansLikeFromChars(formatFixed(value, static_cast<int>(bits() % 22)));
    expectScansLikeFromChars(formatShortest(value));
  }
}

TEST(Number, ScanningDecimalsBesideATieGivesTheNearestDouble) {
  std::mt19937_64 bits(13);
  for (int i = 0; i < 200000; ++i) {
    const double below = 1.0 + std::ldexp(static_cast<double>(bits() >> 12), -48);
    const double above = std::nextafter(below, 100.0);
    // long double has 64 bits: the midpoint is exact, its decimals are not.
    const long double tie = (static_cast<long double>(below) + static_cast<long double>(above)) / 2;
    char decimals[64];
    std::snprintf(decimals, sizeof(decimals), "%.*Lf", 14 + static_cast<int>(bits() % 4), tie);
    expectScansLikeFromChars(decimals);
  }
}

TEST(Number, ScanningStopsBehindTheNumber) {
  const std::string text = "-1.5abc";
  double value = 7.0;
  EXPECT_EQ(scanDouble(text.data(), text.data() + text.size(), value), text.data() + 4);
  EXPECT_EQ(value, -1.5);
  EXPECT_EQ(scanDouble(text.data() + 4, text.data() + text.size(), value), nullptr);
  EXPECT_EQ(value, -1.5);
}

TEST(Number, FixedTextHasItsDecimals) {
  EXPECT_EQ(formatFixed(0.40999, 4), "0.4100");
  EXPECT_EQ(formatFixed(-1.0, 2), "-1.00");
  EXPECT_EQ(formatFixed(std::numeric_limits<double>::max(), 1).size(), 311u);
}

TEST(Number, ScientificTextHasItsDecimals) {
  EXPECT_EQ(formatScientific(1.7e308, 2), "1.70e+308");
  EXPECT_EQ(formatScientific(-std::numeric_limits<double>::max(), 20).size(), 28u);
}

TEST(Number, DoesNotFollowTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no de_DE.UTF-8 here";
  EXPECT_EQ(parseDouble("1.5"), 1.5);
  EXPECT_EQ(formatShortest(1.5), "1.5");
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace pcrb
