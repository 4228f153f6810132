#pragma once

#include <string>
#include <vector>

namespace pcrb {

/// A private parameter of a node, said once: the node's reader and its `--help` take it from here.
struct NodeParameter {
  std::string name;
  std::string fallback;  ///< default as a launch file would give it, or kRequired
  std::string unit;      ///< of a number; of a word: those allowed, separated by `|`; else empty
  std::string help;      ///< a phrase that stands alone
  std::string former_name = {};  ///< under which it is taken, too
};

/// In place of a default: the parameter must be given.
inline constexpr const char* kRequired = "required";

/// A node's parameters in the order of its `--help`. An entry without a name is a heading: its
/// help.
using ParameterTable = std::vector<NodeParameter>;

/// Lines for people: name, default with unit, help, and the words allowed.
std::string formatParameters(const ParameterTable& table);

/// The entry of a name, or nullptr.
const NodeParameter* findParameter(const ParameterTable& table, const std::string& name);

/// Words separated by commas or white space.
std::vector<std::string> splitWords(std::string text);

/// Arguments separated by white space, as in a shell: quotes, single or double, keep a value with
/// blanks together; nothing else is special.
///
/// @param name  of the parameter, for the message.
/// @throws InvalidParameter  if a quote is not closed.
std::vector<std::string> splitArguments(const std::string& name, const std::string& text);

/// The words of a parameter's unit, empty where it has none.
std::vector<std::string> choicesOf(const NodeParameter& parameter);

/// Why a program that roslaunch starts refuses a relative path, and what to write instead; empty
/// for a path that is absolute or empty.
///
/// @param argument  of the launch file.
std::string relativePathMistake(const std::string& argument, const std::string& path);

/// A text with the values of environment variables as a shell puts them in: `$NAME`, `${NAME}`,
/// `${NAME:-other}`.
///
/// @param name  of the parameter, for the message.
/// @throws InvalidParameter  for a variable that is not set, and for any other `$`.
std::string expandVariables(const std::string& name, const std::string& text);

}  // namespace pcrb
