#include "pcrb_server/parameter_table.hpp"

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {

namespace {

constexpr std::size_t kHelpColumn = 36;
constexpr std::size_t kHelpWidth = 100;

/// `a, b or c`, without the word that is empty.
std::string alternatives(std::vector<std::string> words) {
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

/// Name, default and unit.
std::string signatureOf(const NodeParameter& parameter) {
  const bool has_unit = !parameter.unit.empty() && choicesOf(parameter).empty();
  std::string details = parameter.fallback;
  if (has_unit) details += (details.empty() ? "" : " ") + parameter.unit;
  return "  " + parameter.name + (details.empty() ? "" : " (" + details + ")");
}

/// Text in a column of its own, beside what stands to the left of its first line.
std::string inColumn(const std::string& left, const std::string& text) {
  std::string lines;
  std::string line = left;
  if (line.size() + 2 > kHelpColumn) {
    lines = line + "\n";
    line.clear();
  }
  line.resize(kHelpColumn, ' ');
  std::istringstream stream(text);
  bool is_first = true;
  for (std::string word; stream >> word; is_first = false) {
    if (!is_first && line.size() + 1 + word.size() > kHelpWidth) {
      lines += line + "\n";
      line.assign(kHelpColumn, ' ');
      is_first = true;
    }
    line += (is_first ? "" : " ") + word;
  }
  return lines + line + "\n";
}

}  // namespace

std::string formatParameters(const ParameterTable& table) {
  std::string text;
  for (const auto& parameter : table) {
    if (parameter.name.empty()) {
      text += parameter.help + ":\n";
      continue;
    }
    const std::string words = alternatives(choicesOf(parameter));
    text += inColumn(signatureOf(parameter), parameter.help + (words.empty() ? "" : ": " + words));
  }
  return text;
}

const NodeParameter* findParameter(const ParameterTable& table, const std::string& name) {
  const auto found = std::find_if(table.begin(), table.end(), [&name](const auto& parameter) {
    return !name.empty() && parameter.name == name;
  });
  return found == table.end() ? nullptr : &*found;
}

std::vector<std::string> splitWords(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '\n'; }, ' ');
  return splitAtBlanks(text);
}

std::vector<std::string> splitArguments(const std::string& name, const std::string& text) {
  std::vector<std::string> arguments;
  bool is_in_word = false;
  char quote = 0;
  for (const char c : text) {
    const bool is_blank = c == ' ' || c == '\t' || c == '\n';
    if (quote == 0 && is_blank) {
      is_in_word = false;
      continue;
    }
    if (!is_in_word) arguments.emplace_back();
    is_in_word = true;
    if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else {
      arguments.back() += c;
    }
  }
  if (quote != 0) {
    throw InvalidParameter("~" + name + ": found `" + text + "`, expected a second " + quote);
  }
  return arguments;
}

std::vector<std::string> choicesOf(const NodeParameter& parameter) {
  if (parameter.unit.find('|') == std::string::npos) return {};
  std::vector<std::string> words;
  std::istringstream stream(parameter.unit);
  for (std::string word; std::getline(stream, word, '|');) words.push_back(word);
  return words;
}

std::string relativePathMistake(const std::string& argument, const std::string& path) {
  if (path.empty() || path.front() == '/') return "";
  return "found `" + path +
         "`, expected an absolute path: roslaunch starts programs in another folder; write " +
         argument + (startsWith(path, "~/") ? ":=$HOME/" + path.substr(2) : ":=$PWD/" + path);
}

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
