#include "pcrb_core/registration/parameters.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/parallel.hpp"

namespace pcrb {
namespace {

constexpr int kMaxThreads = 256;
constexpr const char* kMethod = "method";
constexpr const char* kOfTheDataSet = "data_set";

template <class Number>
std::string describeRange(const char* type, Number min, Number max) {
  const bool has_min = min > std::numeric_limits<Number>::lowest();
  const bool has_max = max < std::numeric_limits<Number>::max();
  std::string text = type;
  if (has_min) text += (has_max ? " from " : " of at least ") + formatShortest(min);
  if (has_max) text += (has_min ? " to " : " of at most ") + formatShortest(max);
  return text;
}

/// Whether a parameter is the edge of a voxel grid's cells.
bool isLeaf(const std::string& name) { return endsWith(name, "_leaf") && name != "_leaf"; }

class ParameterFile {
 public:
  explicit ParameterFile(const std::string& path) : path_(path) {}

  void read(Parameters& values, std::map<std::string, Parameters>& overrides) const {
    const YAML::Node root = parse();
    values = readValues(root, true);
    for (const auto& entry : root) {
      if (!entry.second.IsMap()) continue;
      const Parameters different = readValues(entry.second, false);
      requireKnown(different, values, entry.second);
      overrides[entry.first.Scalar()] = different;
    }
  }

 private:
  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& found,
                           const std::string& expected) const {
    const int line = mark.is_null() ? 0 : mark.line + 1;
    throw InvalidFile(path_, static_cast<std::size_t>(line), found, expected);
  }

  YAML::Node parse() const {
    const FileBytes file(path_);
    try {
      const YAML::Node root = YAML::Load(std::string(file.text()));
      if (!root.IsMap()) refuse(root.Mark(), "no map", "lines of `name: value`");
      return root;
    } catch (const YAML::ParserException& error) {
      refuse(error.mark, error.msg, "YAML");
    }
  }

  // yaml-cpp keeps both of two equal keys, and finds the first.
  Parameters readValues(const YAML::Node& map, bool maps_allowed) const {
    Parameters values;
    std::set<std::string> seen;
    for (const auto& entry : map) {
      if (!entry.first.IsScalar()) refuse(entry.first.Mark(), "a key that is no name", "a name");
      const std::string& name = entry.first.Scalar();
      if (!seen.insert(name).second) {
        refuse(entry.first.Mark(), inQuotes(name) + " again", "it once");
      }
      if (entry.second.IsScalar()) {
        values[name] = entry.second.Scalar();
        if (values[name] == kOfTheDataSet && !isLeaf(name)) {
          refuse(entry.first.Mark(), inQuotes(name) + " as the data set has it",
                 "a value: a data set has leaves only");
        }
      } else if (!maps_allowed || !entry.second.IsMap()) {
        refuse(entry.first.Mark(), inQuotes(name) + " without a single value",
               maps_allowed ? "a value, or a map with the values of a data set" : "a value");
      }
    }
    return values;
  }

  void requireKnown(const Parameters& overrides, const Parameters& parameters,
                    const YAML::Node& map) const {
    for (const auto& [name, value] : overrides) {
      if (parameters.count(name) == 0) {
        refuse(map[name].Mark(), inQuotes(name) + " for one data set only",
               "a name that the file's top level has too");
      }
    }
  }

  std::string path_;
};

}  // namespace

const std::string* ParameterReader::find(const std::string& name,
                                         const std::string& default_value) {
  defaults_[name] = default_value;
  const auto found = parameters_.find(name);
  return found == parameters_.end() ? nullptr : &found->second;
}

void ParameterReader::refuse(const std::string& name, const std::string& found,
                             const std::string& expected) {
  mistakes_.push_back(name + ": found " + inQuotes(found) + ", expected " + expected);
}

double ParameterReader::number(const std::string& name, double default_value, double min,
                               double max) {
  const std::string* text = find(name, formatShortest(default_value));
  if (text == nullptr) return default_value;
  const auto value = parseDouble(*text);
  if (value && *value >= min && *value <= max) return *value;
  refuse(name, *text, describeRange("a number", min, max));
  return default_value;
}

double ParameterReader::positive(const std::string& name, double default_value) {
  const std::string* text = find(name, formatShortest(default_value));
  if (text == nullptr) return default_value;
  const auto value = parseDouble(*text);
  if (value && *value > 0.0 && std::isfinite(*value)) return *value;
  refuse(name, *text, "a number greater than 0");
  return default_value;
}

int ParameterReader::integer(const std::string& name, int default_value, int min, int max) {
  const std::string* text = find(name, std::to_string(default_value));
  if (text == nullptr) return default_value;
  const auto value = parseInt(*text);
  if (value && *value >= min && *value <= max) return static_cast<int>(*value);
  refuse(name, *text, describeRange("an integer", min, max));
  return default_value;
}

bool ParameterReader::boolean(const std::string& name, bool default_value) {
  const std::string* text = find(name, default_value ? "true" : "false");
  if (text == nullptr) return default_value;
  if (*text == "true") return true;
  if (*text == "false") return false;
  refuse(name, *text, "true or false");
  return default_value;
}

std::uint64_t ParameterReader::seed(const std::string& name, std::uint64_t default_value) {
  const std::string* text = find(name, std::to_string(default_value));
  if (text == nullptr) return default_value;
  if (const auto value = parseUnsigned(*text)) return *value;
  refuse(name, *text, "an integer from 0 to 2^64 - 1");
  return default_value;
}

int ParameterReader::threads() {
  const int threads = integer("threads", 0, 0, kMaxThreads);
  return threads == 0 ? processorCount() : threads;
}

void ParameterReader::check(const std::string& method) const {
  std::vector<std::string> mistakes = mistakes_;
  for (const auto& [name, value] : parameters_) {
    if (defaults_.count(name) == 0) {
      mistakes.push_back(name + ": no parameter of this method (found " + inQuotes(value) + ")");
    }
  }
  if (mistakes.empty()) return;
  std::ostringstream message;
  message << "method " << method << ": " << mistakes.size()
          << (mistakes.size() == 1 ? " wrong parameter" : " wrong parameters");
  for (const auto& mistake : mistakes) message << "\n  " << mistake;
  message << "\n  its parameters:";
  for (const auto& [name, value] : defaults_) message << " " << name << "=" << value;
  throw InvalidParameter(message.str());
}

MethodParameters::MethodParameters(const std::string& path) {
  ParameterFile(path).read(values_, overrides_);
  const auto method = values_.find(kMethod);
  if (method == values_.end()) return;
  method_ = method->second;
  values_.erase(method);
}

Parameters MethodParameters::of(const std::string& data_set, double voxel_leaf) const {
  Parameters parameters = asWritten(data_set);
  for (auto& [name, value] : parameters) {
    if (value == kOfTheDataSet) value = formatShortest(voxel_leaf);
  }
  return parameters;
}

Parameters MethodParameters::asWritten(const std::string& data_set) const {
  Parameters parameters = values_;
  const auto found = overrides_.find(data_set);
  if (found == overrides_.end()) return parameters;
  for (const auto& [name, value] : found->second) parameters[name] = value;
  return parameters;
}

std::vector<std::string> MethodParameters::dataSets() const {
  std::vector<std::string> names;
  for (const auto& [name, overrides] : overrides_) names.push_back(name);
  return names;
}

}  // namespace pcrb
