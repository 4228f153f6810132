#include "conversion/converter_options.hpp"

#include <algorithm>
#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

constexpr double kMaxNumber = 1e6;

std::string flagOf(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

/// Numbers of a parameter, e.g. "525 525 319.5 239.5"; empty where it is not given.
std::vector<double> readNumbers(pcrb::NodeParameters& parameters, const std::string& name,
                                std::size_t count) {
  const auto words = parameters.words(name);
  std::vector<double> numbers;
  for (const auto& word : words) {
    const auto number = pcrb::parseDouble(word);
    if (number && std::isfinite(*number)) numbers.push_back(*number);
  }
  if (numbers.size() == words.size() && (words.empty() || words.size() == count)) return numbers;
  parameters.addMistake("~" + name + ": expected " + std::to_string(count) +
                        " numbers separated by blanks, as text");
  return {};
}

pcrb::Stamp toStampOfFlag(const std::string& flag, double seconds) {
  try {
    return pcrb::toStamp(seconds);
  } catch (const pcrb::InvalidParameter& error) {
    throw CLI::ValidationError(flag, error.what());
  }
}

}  // namespace

void ConverterOptions::addText(const std::string& name, std::string& value, const std::string& help,
                               Use use) {
  const bool is_required = use != Use::kOptional;
  options_.push_back({name, is_required ? pcrb::kRequired : value, "", help, use,
                      [&value](CLI::App& app, const std::string& flag) {
                        CLI::Option* const option = app.add_option(flag, value);
                        if (!value.empty()) option->capture_default_str();
                        return option;
                      },
                      [&value](pcrb::NodeParameters& parameters, const std::string& key) {
                        value = parameters.string(key);
                      }});
}

void ConverterOptions::addPath(const std::string& name, std::string& value,
                               const std::string& help) {
  addText(name, value, help, Use::kRequired);
  options_.back().read = [&value](pcrb::NodeParameters& parameters, const std::string& key) {
    value = parameters.path(key);
  };
}

void ConverterOptions::addInteger(const std::string& name, int& value, int min, int max,
                                  const std::string& help, Use use) {
  options_.push_back(
      {name, std::to_string(value), "", help, use,
       [&value, min, max](CLI::App& app, const std::string& flag) {
         return app.add_option(flag, value)->check(CLI::Range(min, max))->capture_default_str();
       },
       [&value, min, max](pcrb::NodeParameters& parameters, const std::string& key) {
         value = parameters.integer(key, min, max);
       }});
}

void ConverterOptions::addNumber(const std::string& name, double& value, const std::string& help,
                                 Use use) {
  const std::string default_text = pcrb::formatShortest(value);
  addNumber(
      name, [&value](double number) { value = number; }, help);
  Option& option = options_.back();
  option.fallback = default_text;
  option.use = use;
  const AddFlag add_flag = option.add_flag;
  option.add_flag = [add_flag, default_text](CLI::App& app, const std::string& flag) {
    return add_flag(app, flag)->default_str(default_text);
  };
}

void ConverterOptions::addNumber(const std::string& name, const std::function<void(double)>& set,
                                 const std::string& help) {
  options_.push_back({name, "", "", help, Use::kOptional,
                      [set](CLI::App& app, const std::string& flag) {
                        return app.add_option_function<double>(flag, set)->check(
                            CLI::Range(0.0, kMaxNumber));
                      },
                      [set](pcrb::NodeParameters& parameters, const std::string& key) {
                        const double number = parameters.number(key, 0.0, kMaxNumber);
                        if (!std::isnan(number)) set(number);
                      }});
}

void ConverterOptions::addSeconds(const std::string& name, pcrb::Stamp& value,
                                  const std::string& help) {
  const double fallback = static_cast<double>(value) / 1e9;
  options_.push_back({name, pcrb::formatShortest(fallback), "s", help, Use::kOptional,
                      [&value, fallback](CLI::App& app, const std::string& flag) {
                        const auto set = [&value, flag](double s) {
                          value = toStampOfFlag(flag, s);
                        };
                        return app.add_option_function<double>(flag, set)->default_str(
                            pcrb::formatShortest(fallback));
                      },
                      [&value](pcrb::NodeParameters& parameters, const std::string& key) {
                        value = pcrb::toStamp(parameters.number(key, 0.0, kMaxNumber));
                      }});
}

void ConverterOptions::addNumbers(const std::string& name, int count,
                                  const std::function<void(const std::vector<double>&)>& set,
                                  const std::string& help) {
  options_.push_back(
      {name, "", "", help, Use::kOptional,
       [set, count](CLI::App& app, const std::string& flag) {
         return app.add_option_function<std::vector<double>>(flag, set)->expected(count);
       },
       [set, count](pcrb::NodeParameters& parameters, const std::string& key) {
         const auto numbers = readNumbers(parameters, key, static_cast<std::size_t>(count));
         if (!numbers.empty()) set(numbers);
       }});
}

void ConverterOptions::addSwitch(const std::string& name, const std::function<void()>& turn_on,
                                 const std::string& help) {
  options_.push_back({name, "false", "", help, Use::kOptional,
                      [turn_on](CLI::App& app, const std::string& flag) {
                        return app.add_flag_function(flag, [turn_on](auto) { turn_on(); });
                      },
                      [turn_on](pcrb::NodeParameters& parameters, const std::string& key) {
                        if (parameters.boolean(key)) turn_on();
                      }});
}

void ConverterOptions::addChoice(const std::string& name,
                                 const std::function<void(const std::string&)>& set,
                                 const std::vector<std::string>& choices,
                                 const std::vector<std::string>& live_choices,
                                 const std::string& help) {
  options_.push_back({name, live_choices.front(), pcrb::joined(live_choices, "|"), help,
                      Use::kOptional,
                      [set, choices](CLI::App& app, const std::string& flag) {
                        return app.add_option_function<std::string>(flag, set)
                            ->check(CLI::IsMember(choices))
                            ->default_str(choices.front());
                      },
                      [set](pcrb::NodeParameters& parameters, const std::string& key) {
                        set(parameters.choice(key));
                      }});
}

void ConverterOptions::addFlags(CLI::App& app) const {
  for (const Option& option : options_) {
    if (option.use == Use::kOnlyLive) continue;
    CLI::Option* const flag = option.add_flag(app, flagOf(option.name));
    flag->description(option.help)->required(option.use == Use::kRequired);
  }
}

pcrb::ParameterTable ConverterOptions::parameters() const {
  pcrb::ParameterTable table;
  for (const Option& option : options_) {
    table.push_back({option.name, option.fallback, option.unit, option.help});
  }
  return table;
}

void ConverterOptions::read(pcrb::NodeParameters& parameters) const {
  for (const Option& option : options_) option.read(parameters, option.name);
}

}  // namespace pcrb_tools
