#pragma once

#include <string>

// Floating point as std::from_chars and std::to_chars have it, by the C library, whose conversions
// are correctly rounded: where speed does not count, and for standard libraries that convert
// integers only (GCC before 11). The same to the bit; independent of the locale.

namespace pcrb::c_number {

/// Reads the longest number at the start of [begin, end): digits, fixed or scientific, or nan, inf,
/// infinity in any case, with a minus sign or none.
///
/// @return  one past its last character, or nullptr if there is no number or it is out of double's
///          range.
const char* scan(const char* begin, const char* end, double& value);

/// The shortest text that reads back to the same double, of several the nearest; fixed notation
/// where scientific is not shorter.
std::string shortest(double value);

/// With a fixed number of decimals, rounded half to even on the exact value.
std::string fixed(double value, int decimals);
std::string scientific(double value, int decimals);

}  // namespace pcrb::c_number
