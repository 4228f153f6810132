#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "conversion/conversion.hpp"
#include "pcrb_core/datasets/stamp.hpp"

namespace pcrb_tools {

/// Adds the options that all converters have.
/// @param inputs  what the inputs are, for `--help`
void addConversionOptions(CLI::App& app, ConversionRequest& request, const std::string& inputs);

/// Adds an option in seconds.
void addSecondsOption(CLI::App& app, const std::string& name, pcrb::Stamp& value,
                      const std::string& description);

/// Parses the command line, converts and prints the report: what a converter's main ends with.
int runConversion(CLI::App& app, int argc, char** argv, const ConversionRequest& request,
                  const std::function<ConversionReport()>& convert);

}  // namespace pcrb_tools
