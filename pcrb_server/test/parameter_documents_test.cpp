#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "bridge/bridge_parameters.hpp"
#include "pcrb_server/parameter_table.hpp"
#include "replay/replay.hpp"
#include "server/server_parameters.hpp"
#include "supervisor/node_supervisor.hpp"
#include "verdict/evaluation.hpp"

namespace pcrb {
namespace {

const std::string kRepository = PCRB_REPOSITORY;

/// Tables by the type of the node.
const std::map<std::string, const ParameterTable*> kTables{
    {"localization_bridge", &kBridgeParameters},
    {"node_supervisor", &kSupervisorParameters},
    {"benchmark_server", &kServerParameters},
    {"replay", &kReplayParameters},
    {"evaluation_test", &kEvaluationParameters}};

/// Defaults of launch arguments that are others than the node's, on purpose.
const std::set<std::string> kOwnDefaults{"node_launch", "rviz"};

const char* attribute(const tinyxml2::XMLElement& element, const char* name) {
  const char* const value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

/// Checks the parameters that a launch file gives to nodes with tables against these.
class LaunchFile {
 public:
  explicit LaunchFile(const std::string& name) : name_(name) {
    EXPECT_EQ(document_.LoadFile((kRepository + "/launch/" + name).c_str()), 0) << name;
    const auto* const launch = document_.FirstChildElement("launch");
    for (const auto* arg = launch->FirstChildElement("arg"); arg != nullptr;
         arg = arg->NextSiblingElement("arg")) {
      if (arg->Attribute("default") != nullptr) {
        defaults_[attribute(*arg, "name")] = attribute(*arg, "default");
      }
    }
    check(*launch);
  }

  int checked() const { return checked_; }

 private:
  void check(const tinyxml2::XMLElement& element) {
    const auto table = kTables.find(attribute(element, "type"));
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const bool is_parameter = std::string(child->Name()) == "param";
      if (is_parameter && table != kTables.end()) checkParameter(*child, *table->second);
      check(*child);
    }
  }

  void checkParameter(const tinyxml2::XMLElement& parameter, const ParameterTable& table) {
    const std::string name = attribute(parameter, "name");
    const NodeParameter* const entry = findParameter(table, name);
    ASSERT_NE(entry, nullptr) << name_ << ": " << name;
    ++checked_;
    std::smatch argument;
    const std::string value = attribute(parameter, "value");
    if (!std::regex_match(value, argument, std::regex(R"(\$\(arg (\w+)\))"))) return;
    const auto given = defaults_.find(argument[1]);
    const bool is_computed =
        given == defaults_.end() || given->second.find("$(") != std::string::npos;
    if (is_computed || kOwnDefaults.count(argument[1]) > 0) return;
    EXPECT_EQ(given->second, entry->fallback) << name_ << ": default of " << argument[1];
  }

  std::string name_;
  tinyxml2::XMLDocument document_;
  std::map<std::string, std::string> defaults_;
  int checked_ = 0;
};

/// What stands in backticks, one after the other.
std::vector<std::string> quoted(const std::string& text) {
  static const std::regex kQuoted("`~?([^`]*)`");
  std::vector<std::string> words;
  for (std::sregex_iterator i(text.begin(), text.end(), kQuoted), end; i != end; ++i) {
    words.push_back((*i)[1]);
  }
  return words;
}

/// Names and defaults of the parameters in the tables of a document: `name` | `default` | …
std::map<std::string, std::string> documentedDefaults(const std::string& document) {
  static const std::regex kRow(R"(\| (`~?\w+`(?:, `~?\w+`)*) \|([^|]*)\|.*)");
  std::map<std::string, std::string> defaults;
  std::ifstream file(kRepository + "/docs/" + document);
  EXPECT_TRUE(file) << document;
  for (std::string line; std::getline(file, line);) {
    std::smatch row;
    if (!std::regex_match(line, row, kRow)) continue;
    const auto names = quoted(row[1]);
    const auto values = quoted(row[2]);
    for (std::size_t i = 0; i < names.size(); ++i) {
      defaults[names[i]] = i < values.size() ? values[i] : "";
    }
  }
  return defaults;
}

/// @return  number of parameters of the table that the document names.
int expectDefaults(const std::string& document, const ParameterTable& table) {
  int found = 0;
  for (const auto& [name, value] : documentedDefaults(document)) {
    const NodeParameter* const entry = findParameter(table, name);
    if (entry == nullptr) continue;
    ++found;
    if (entry->fallback != kRequired) {
      EXPECT_EQ(value, entry->fallback) << document << ": " << name;
    }
  }
  return found;
}

TEST(ParameterDocuments, LaunchFilesGiveParametersThatNodesHaveWithTheSameDefaults) {
  EXPECT_GT(LaunchFile("localization.launch").checked(), 10);
  EXPECT_GT(LaunchFile("benchmark.launch").checked(), 10);
  EXPECT_GT(LaunchFile("replay.launch").checked(), 10);
  EXPECT_GT(LaunchFile("evaluate.test").checked(), 5);
}

TEST(ParameterDocuments, DocumentsStateTheDefaultsOfTheNodes) {
  EXPECT_GT(expectDefaults("regression_test.md", kEvaluationParameters), 3);
  EXPECT_GT(expectDefaults("your_node.md", kBridgeParameters), 5);
  EXPECT_GT(expectDefaults("interface.md", kServerParameters), 15);
}

TEST(ParameterDocuments, EveryParameterHasAHelpAndAName) {
  for (const auto& [node, table] : kTables) {
    std::set<std::string> names;
    for (const auto& parameter : *table) {
      EXPECT_FALSE(parameter.help.empty()) << node << ": " << parameter.name;
      const bool is_new = parameter.name.empty() || names.insert(parameter.name).second;
      EXPECT_TRUE(is_new) << node << ": " << parameter.name;
    }
  }
}

}  // namespace
}  // namespace pcrb
