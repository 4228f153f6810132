#include "pcrb_core/registration/method_parameters.hpp"

#include <yaml-cpp/yaml.h>

#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

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

MethodParameters::MethodParameters(const std::string& path) {
  ParameterFile(path).read(values_, overrides_);
}

Parameters MethodParameters::of(const std::string& data_set) const {
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
