#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pcrb {

// All conversion between numbers and text of the suite: independent of the locale, of the compiler
// and of its standard library.

/// Reads the decimal number at the start of [begin, end): a sign or none, fixed or scientific, or
/// nan, inf, infinity in any case.
///
/// @return  one past its last character, or nullptr if there is no number or it is out of double's
///          range; `value`, the nearest double, is set in the first case only.
const char* scanDouble(const char* begin, const char* end, double& value) noexcept;

/// The number that the whole text is, else nothing: no blanks around it, no text behind it.
std::optional<double> parseDouble(std::string_view text) noexcept;

/// The integer that the whole text is, else nothing; out of range counts as nothing.
std::optional<std::int64_t> parseInt(std::string_view text) noexcept;
std::optional<std::uint64_t> parseUnsigned(std::string_view text) noexcept;

/// Appends the shortest text that reads back to the same double (`nan`, `inf`, `-inf` included).
void appendShortest(std::string& text, double value);

/// The same into memory, for what writes millions: kLongestNumber characters must be free at `out`.
/// @return  one past the last character.
constexpr std::size_t kLongestNumber = 32;
char* writeShortest(char* out, double value) noexcept;

std::string formatShortest(double value);

/// Appends with a fixed number of decimals, rounded half to even on the exact value.
void appendFixed(std::string& text, double value, int decimals);
std::string formatFixed(double value, int decimals);

/// A number in scientific notation, e.g. `1.70e+308`, rounded like formatFixed.
std::string formatScientific(double value, int decimals);

}  // namespace pcrb
