#pragma once

#include <CLI/CLI.hpp>

#include "conversion/kaist_conversion.hpp"

namespace pcrb_tools {

/// Adds the options of `kaist_to_pcd` beside those that all converters have.
void addKaistOptions(CLI::App& app, KaistRequest& request);

}  // namespace pcrb_tools
