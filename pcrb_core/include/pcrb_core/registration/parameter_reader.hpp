#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "pcrb_core/registration/registration.hpp"

namespace pcrb {

/// Reads a method's parameters from text and collects all mistakes, so that a user sees them at
/// once. A method reads every parameter that it has in its constructor; whoever made the reader
/// then calls check().
class ParameterReader {
 public:
  explicit ParameterReader(Parameters parameters) : parameters_(std::move(parameters)) {}

  /// The value of a parameter, or its default where it is not given. A mistake is noted, and the
  /// default returned; bounds are inclusive, a bound in the message has the parameter's unit.
  double number(const std::string& name, double default_value,
                double min = std::numeric_limits<double>::lowest(),
                double max = std::numeric_limits<double>::max());
  /// A number greater than 0.
  double positive(const std::string& name, double default_value);
  int integer(const std::string& name, int default_value,
              int min = std::numeric_limits<int>::lowest(),
              int max = std::numeric_limits<int>::max());
  bool boolean(const std::string& name, bool default_value);  ///< `true` or `false`
  std::uint64_t seed(const std::string& name, std::uint64_t default_value);

  /// The parameter `threads`: 0, the default, stands for all cores of the machine.
  int threads();

  /// @throws InvalidParameter  listing all mistakes: wrong types, impossible values, and parameters
  /// that nobody read.
  /// @param method  its name, for the message.
  void check(const std::string& method) const;

  /// What was read so far, with default values.
  const Parameters& defaults() const { return defaults_; }

 private:
  const std::string* find(const std::string& name, const std::string& default_value);
  void refuse(const std::string& name, const std::string& found, const std::string& expected);

  Parameters parameters_;
  Parameters defaults_;
  std::vector<std::string> mistakes_;
};

}  // namespace pcrb
