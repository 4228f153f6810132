#include "conversion/conversion_main.hpp"

#include "common/interruption.hpp"
#include "common/tool_main.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/parallel.hpp"

namespace pcrb_tools {

void addConversionOptions(CLI::App& app, ConversionRequest& request, const std::string& inputs) {
  request.threads = pcrb::processorCount();
  app.add_option("INPUT", request.inputs, inputs)->required();
  app.add_option("--root", request.root,
                 "Root of the common layout: clouds go to "
                 "ROOT/DATA_SET/SEQUENCE/*.pcd")
      ->required();
  app.add_option("--data-set", request.data_set, "Folder of the data set")->capture_default_str();
  app.add_option("--sequence", request.sequence,
                 "Folder of the sequence (default: from the names of the inputs)");
  app.add_option("--threads", request.threads, "Does not change a byte")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--force", request.force, "Replace clouds that no converter made");
}

void addSecondsOption(CLI::App& app, const std::string& name, pcrb::Stamp& value,
                      const std::string& description) {
  app.add_option_function<double>(
         name,
         [&value, name](double seconds) {
           try {
             value = pcrb::toStamp(seconds);
           } catch (const pcrb::InvalidParameter& error) {
             throw CLI::ValidationError(name, error.what());
           }
         },
         description)
      ->default_str(pcrb::formatShortest(static_cast<double>(value) / 1e9));
}

int runConversion(CLI::App& app, int argc, char** argv, const ConversionRequest& request,
                  const std::function<ConversionReport()>& convert) {
  return runTool(app, argc, argv, [&] {
    const Interruption interruption;
    printReport(request, convert());
    return kSuccess;
  });
}

}  // namespace pcrb_tools
