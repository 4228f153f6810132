#include "expand_variables.hpp"

#include <cstdlib>
#include <regex>

#include "pcrb_core/error.hpp"

namespace pcrb {

// wordexp() of glibc 2.36 takes ${NAME:-other} for an error where unset names are one.
std::string expandVariables(const std::string& name, const std::string& text) {
  static const std::regex kVariable(R"(^\$(?:(\w+)|\{(\w+)(?::-([^}]*))?\}))");
  std::string expanded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '$') {
      expanded += text[i];
      continue;
    }
    const std::string rest = text.substr(i);
    std::smatch found;
    const bool is_variable = std::regex_search(rest, found, kVariable);
    const char* value =
        is_variable ? std::getenv((found[1].str() + found[2].str()).c_str()) : nullptr;
    if (value == nullptr && !(is_variable && found[3].matched)) {
      throw InvalidParameter(name + ": found `" + rest + "`" +
                             (is_variable ? ", which is not set" : "") +
                             ", expected variables of the environment such as ${TMPDIR:-/tmp}");
    }
    expanded += value != nullptr ? std::string(value) : found[3].str();
    i += static_cast<std::size_t>(found.length()) - 1;
  }
  return expanded;
}

}  // namespace pcrb
