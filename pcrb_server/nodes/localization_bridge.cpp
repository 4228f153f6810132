#include "bridge/localization_bridge.hpp"

#include "pcrb_server/node_main.hpp"

namespace pcrb::localization_bridge {
namespace {

const NodeHelp kHelp{
    "localization_bridge",
    "Makes an unchanged localization node a client of the benchmark: gives "
    "it map, initial pose and scans, reads its poses, submits them.",
    R"(The benchmark's side: problem, target, source, summary; ready, submit_pose; in the namespace /pcrb
unless another is given. Ends when the server says that the run is over.)",
    kBridgeParameters};

}  // namespace

int run(int argc, char** argv) {
  return runNode(argc, argv, kHelp, [](ShutdownRequest& shutdown) {
    const BridgeParameters parameters = readBridgeParameters();
    return LocalizationBridge(parameters, shutdown).run() ? 0 : 1;
  });
}

}  // namespace pcrb::localization_bridge
