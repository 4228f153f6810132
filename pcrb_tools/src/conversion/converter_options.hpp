#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_server/node_parameters.hpp"

namespace pcrb_tools {

/// The options of a converter, each said once: a flag `--max-gap` of the program and a parameter
/// `~max_gap` of its node. What they set must outlive the list.
class ConverterOptions {
 public:
  /// Which of the two has an option, and whether its value must be given.
  enum class Use { kOptional, kRequiredLive, kRequired, kOnlyLive };

  /// @param name  with underscores; the flag has hyphens.
  /// @param help  a phrase with its unit; the default value follows it.
  void addText(const std::string& name, std::string& value, const std::string& help,
               Use use = Use::kOptional);

  /// A path, which must be absolute for the node.
  void addPath(const std::string& name, std::string& value, const std::string& help);

  void addInteger(const std::string& name, int& value, int min, int max, const std::string& help,
                  Use use = Use::kOptional);

  /// A number >= 0.
  void addNumber(const std::string& name, double& value, const std::string& help,
                 Use use = Use::kOptional);

  /// A number >= 0 without a fixed default, which the help names.
  void addNumber(const std::string& name, const std::function<void(double)>& set,
                 const std::string& help);

  /// A time in seconds.
  void addSeconds(const std::string& name, pcrb::Stamp& value, const std::string& help);

  /// Several numbers.
  void addNumbers(const std::string& name, int count,
                  const std::function<void(const std::vector<double>&)>& set,
                  const std::string& help);

  /// Something that is off unless asked for.
  void addSwitch(const std::string& name, const std::function<void()>& turn_on,
                 const std::string& help);

  /// One of some words; the first is the default.
  /// @param live_choices  those of the node.
  void addChoice(const std::string& name, const std::function<void(const std::string&)>& set,
                 const std::vector<std::string>& choices,
                 const std::vector<std::string>& live_choices, const std::string& help);

  /// Adds the flags to a command line.
  void addFlags(CLI::App& app) const;

  /// The node's parameters.
  pcrb::ParameterTable parameters() const;

  /// Reads them; mistakes are kept by the reader.
  void read(pcrb::NodeParameters& parameters) const;

 private:
  using AddFlag = std::function<CLI::Option*(CLI::App&, const std::string& flag)>;
  using Read = std::function<void(pcrb::NodeParameters&, const std::string& name)>;
  struct Option {
    std::string name;
    std::string fallback;  ///< of the parameter, as in its table
    std::string unit;      ///< likewise
    std::string help;
    Use use;
    AddFlag add_flag;
    Read read;
  };

  std::vector<Option> options_;
};

}  // namespace pcrb_tools
