#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "pcrb_core/registration/registration.hpp"

namespace pcrb {

/// Reads a method's parameters from text and collects all mistakes, so that a user sees them at
/// once. A method reads every parameter that it has in its constructor; the reader's owner then
/// calls check().
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
  /// that the method did not read.
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

/// A method's parameter file, as it was when it was read: what is written into it later changes
/// nothing.
///
/// YAML: one `name: value` a line; values are numbers, true, false or text. A map instead of a
/// value holds what is different for the data set of that name, and only names that the file has at
/// its top level:
///
///     voxel_leaf: data_set       # m
///     seed: 1
///     tum: {seed: 2}
///
/// `data_set` as the value of `voxel_leaf`, or another name that ends in `_leaf`, stands for the
/// leaf of the problem's data set. `method: NAME` says which method the parameters are for, where
/// the file has another name.
class MethodParameters {
 public:
  /// @throws InvalidFile  with file and line, what was found and what was expected.
  explicit MethodParameters(const std::string& path);

  /// @param data_set    e.g. `tum`; one that the file does not mention gets the top level's values.
  /// @param voxel_leaf  m, of the data set: Dataset::voxel_leaf, or that of pcrb_msgs/Problem.
  Parameters of(const std::string& data_set, double voxel_leaf) const;

  /// The method that the file is for; empty where it does not say.
  const std::string& method() const { return method_; }

  /// The same with `data_set` where the file says so.
  Parameters asWritten(const std::string& data_set) const;

  /// Those that the file mentions, sorted.
  std::vector<std::string> dataSets() const;

 private:
  std::string method_;
  Parameters values_;
  std::map<std::string, Parameters> overrides_;  // by data set
};

}  // namespace pcrb
