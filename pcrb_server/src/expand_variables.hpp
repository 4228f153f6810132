#pragma once

#include <string>

namespace pcrb {

/// A text with the values of environment variables as a shell puts them in: `$NAME`, `${NAME}`,
/// `${NAME:-other}`.
///
/// @param name  of the parameter, for the message.
/// @throws InvalidParameter  for a variable that is not set, and for any other `$`.
std::string expandVariables(const std::string& name, const std::string& text);

}  // namespace pcrb
