#include <iostream>

#include "common/tool_main.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools::import_protocol {

int run(int argc, char** argv) {
  CLI::App app(
      "Makes a problem file of the protocol of the original ETH evaluation: its pairs of scans "
      "with "
      "its initial poses.");
  app.footer(
      "Example: import_protocol apartment_protocol.csv ~/pcrb/eth/apartment \\\n"
      "  --output ~/protocol/eth/apartment_global.txt\n"
      "Its perturbations are larger than those of local problems: a root of their own, with a link "
      "to the clouds, keeps them apart from the published ones.");
  ProtocolOptions options;
  app.add_option("protocol", options.protocol, "<sequence>_protocol.csv")->required();
  app.add_option("folder", options.folder, "<root>/<data set>/<sequence>")->required();
  app.add_option("-o,--output", options.output, "problem file to write")->required();
  app.add_flag("--force", options.force, "replace a problem file that this program did not make");
  addThreadsOption(app, options.threads);
  return runTool(app, argc, argv, [&options] {
    runProtocolImport(options, std::cout);
    return kSuccess;
  });
}

}  // namespace pcrb_tools::import_protocol
