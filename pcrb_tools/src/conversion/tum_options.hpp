#pragma once

#include <CLI/CLI.hpp>

#include "conversion/tum_conversion.hpp"

namespace pcrb_tools {

/// Adds the options of `tum_to_pcd` beside those that all converters have.
void addTumOptions(CLI::App& app, TumRequest& request);

}  // namespace pcrb_tools
