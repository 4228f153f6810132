#pragma once

#include <string>

#include "pcrb_core/registration/registration.hpp"

namespace pcrb {

/// Reads a method's parameter file for a data set.
///
/// YAML: one `name: value` a line; values are numbers, true, false or text. A map instead of a
/// value holds what is different for the data set of that name, and only names that the file has at
/// its top level:
///
///     voxel_leaf: 0.2            # m
///     tum: {voxel_leaf: 0.1}     # m
///
/// @param data_set  e.g. `tum`; one that the file does not mention gets the top level's values.
/// @throws InvalidFile  with file and line, what was found and what was expected.
Parameters loadMethodParameters(const std::string& path, const std::string& data_set);

}  // namespace pcrb
