#pragma once

#include <map>
#include <string>
#include <vector>

#include "pcrb_core/registration/registration.hpp"

namespace pcrb {

/// A method's parameter file, as it was when it was read: what is written into it later changes
/// nothing.
///
/// YAML: one `name: value` a line; values are numbers, true, false or text. A map instead of a
/// value holds what is different for the data set of that name, and only names that the file has at
/// its top level:
///
///     voxel_leaf: 0.2            # m
///     tum: {voxel_leaf: 0.1}     # m
class MethodParameters {
 public:
  /// @throws InvalidFile  with file and line, what was found and what was expected.
  explicit MethodParameters(const std::string& path);

  /// @param data_set  e.g. `tum`; one that the file does not mention gets the top level's values.
  Parameters of(const std::string& data_set) const;

  /// Those that the file mentions, sorted.
  std::vector<std::string> dataSets() const;

 private:
  Parameters values_;
  std::map<std::string, Parameters> overrides_;  // by data set
};

}  // namespace pcrb
