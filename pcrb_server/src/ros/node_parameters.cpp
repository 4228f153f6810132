#include "pcrb_server/node_parameters.hpp"

#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {

namespace {

std::string describe(XmlRpc::XmlRpcValue value) {
  std::ostringstream text;
  text << '`';
  value.write(text);
  text << '`';
  return text.str();
}

/// A text parameter. roslaunch and rosrun turn a folder named 2026 or 1.5 into a number, which is
/// taken back here; needless zeros are lost, unless a launch file gives the parameter type="str".
std::optional<std::string> textOf(XmlRpc::XmlRpcValue& value) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeString) return std::string(value);
  if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) return std::to_string(int(value));
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) return formatShortest(double(value));
  return std::nullopt;
}

/// Words of a list, or of a text parameter.
std::optional<std::vector<std::string>> wordsOf(XmlRpc::XmlRpcValue& value) {
  if (const auto text = textOf(value)) return splitWords(*text);
  if (value.getType() != XmlRpc::XmlRpcValue::TypeArray) return std::nullopt;
  std::vector<std::string> words;
  for (int i = 0; i < value.size(); ++i) {
    if (value[i].getType() != XmlRpc::XmlRpcValue::TypeString) return std::nullopt;
    words.push_back(value[i]);
  }
  return words;
}

/// As a launch file would give it.
std::string asWritten(XmlRpc::XmlRpcValue& value) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeBoolean) return bool(value) ? "true" : "false";
  return textOf(value).value_or("");
}

template <typename T>
std::string range(T min, T max) {
  std::ostringstream text;
  text << "from " << min << " to " << max;
  return text.str();
}

}  // namespace

NodeParameters::NodeParameters(ParameterTable table) : table_(std::move(table)), node_("~") {}

const NodeParameter& NodeParameters::entryOf(const std::string& name) const {
  const NodeParameter* const entry = findParameter(table_, name);
  if (entry == nullptr) throw std::logic_error("~" + name + " is in no table of parameters");
  return *entry;
}

std::string NodeParameters::fallbackOf(const std::string& name) const {
  const std::string& fallback = entryOf(name).fallback;
  return fallback == kRequired ? "" : fallback;
}

bool NodeParameters::find(const std::string& name, XmlRpc::XmlRpcValue& value) {
  asked_.insert(name);
  const bool is_argument = node_.getParam(name, value) || findFormer(name, value);
  if (findInGroup(name, value)) return true;
  if (defaults_.empty()) return is_argument;
  const bool is_default = !is_argument || asWritten(value) == fallbackOf(name);
  return (is_default && node_.getParam(defaults_ + "/" + name, value)) || is_argument;
}

bool NodeParameters::findFormer(const std::string& name, XmlRpc::XmlRpcValue& value) {
  const NodeParameter* const entry = findParameter(table_, name);
  if (entry == nullptr || entry->former_name.empty()) return false;
  if (!node_.getParam(entry->former_name, value)) return false;
  asked_.insert(entry->former_name);
  given_as_[name] = entry->former_name;
  return true;
}

/// @param value  that is given outside the group, if there is one; becomes that of the group.
bool NodeParameters::findInGroup(const std::string& name, XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue in_group;
  if (group_.empty() || !node_.getParam(group_ + "/" + name, in_group)) return false;
  const bool is_other = value.valid() && describe(value) != describe(in_group) &&
                        asWritten(value) != fallbackOf(name);
  if (is_other) {
    addMistake("~" + name + ": found " + describe(value) + " as an argument and " +
               describe(in_group) + " in the file of " + group_ + ", expected one of the two");
  }
  value = in_group;
  return true;
}

void NodeParameters::mistake(const std::string& name, const XmlRpc::XmlRpcValue& found,
                             const std::string& expected) {
  const auto former = given_as_.find(name);
  addMistake("~" + (former == given_as_.end() ? name : former->second) + ": found " +
             describe(found) + ", expected " + expected);
}

void NodeParameters::requireValue(const std::string& name, bool is_empty) {
  if (is_empty && entryOf(name).fallback == kRequired) addMistake("~" + name + ": must be given");
}

std::string NodeParameters::string(const std::string& name) {
  XmlRpc::XmlRpcValue value;
  std::string text = fallbackOf(name);
  if (find(name, value)) {
    const auto given = textOf(value);
    if (!given) {
      mistake(name, value, "text");
      return text;
    }
    text = *given;
  }
  requireValue(name, text.empty());
  return text;
}

std::string NodeParameters::path(const std::string& name) {
  const std::string value = string(name);
  const std::string mistake = relativePathMistake(name, value);
  if (!mistake.empty()) addMistake("~" + name + ": " + mistake);
  return value;
}

std::string NodeParameters::choice(const std::string& name) {
  const std::string value = string(name);
  std::string list;
  for (const auto& choice : choicesOf(entryOf(name))) {
    if (choice == value) return value;
    list += (list.empty() ? "`" : " or `") + choice + '`';
  }
  mistake(name, value, list);
  return fallbackOf(name);
}

bool NodeParameters::boolean(const std::string& name) {
  XmlRpc::XmlRpcValue value;
  const bool fallback = fallbackOf(name) == "true";
  if (!find(name, value)) return fallback;
  if (value.getType() == XmlRpc::XmlRpcValue::TypeBoolean) return value;
  mistake(name, value, "true or false");
  return fallback;
}

int NodeParameters::integer(const std::string& name, int min, int max) {
  XmlRpc::XmlRpcValue value;
  const int fallback = static_cast<int>(parseInt(fallbackOf(name)).value_or(min));
  if (!find(name, value)) return fallback;
  if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) {
    const int number = value;
    if (number >= min && number <= max) return number;
  }
  mistake(name, value, "a whole number " + range(min, max));
  return fallback;
}

double NodeParameters::number(const std::string& name, double min, double max) {
  XmlRpc::XmlRpcValue value;
  const double fallback = parseDouble(fallbackOf(name)).value_or(NAN);
  if (!find(name, value)) return fallback;
  double number = NAN;
  if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) number = int(value);
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) number = value;
  if (number >= min && number <= max) return number;
  mistake(name, value, "a number " + range(min, max));
  return fallback;
}

std::vector<std::string> NodeParameters::words(const std::string& name) {
  XmlRpc::XmlRpcValue value;
  std::vector<std::string> words = splitWords(fallbackOf(name));
  if (find(name, value)) {
    const auto given = wordsOf(value);
    if (!given) {
      mistake(name, value, "a list of words");
      return words;
    }
    words = *given;
  }
  requireValue(name, words.empty());
  return words;
}

void NodeParameters::check(const std::function<void()>& statement) {
  try {
    statement();
  } catch (const Error& error) {
    addMistake(error.what());
  }
}

/// Names of the group count like those outside.
void NodeParameters::checkNames() {
  std::vector<std::string> names;
  node_.getParamNames(names);
  const std::string prefix = node_.getNamespace() + "/";
  for (const auto& name : names) {
    if (!startsWith(name, prefix)) continue;
    std::string rest = name.substr(prefix.size());
    for (const std::string& group : {group_, defaults_}) {
      if (!group.empty() && startsWith(rest, group + "/")) rest.erase(0, group.size() + 1);
    }
    const std::string key = rest.substr(0, rest.find('/'));
    if (asked_.insert(key).second) addMistake("~" + key + ": no parameter of this node");
  }
}

void NodeParameters::finish() {
  checkNames();
  if (mistakes_.empty()) return;
  std::string message = std::to_string(mistakes_.size()) +
                        (mistakes_.size() == 1 ? " mistake" : " mistakes") + " in the parameters";
  for (const auto& mistake : mistakes_) message += "\n  " + mistake;
  throw InvalidParameter(message);
}

}  // namespace pcrb
