#include "bridge/localization_bridge.hpp"

#include "pcrb_server/node_main.hpp"

namespace {

const pcrb::NodeHelp kHelp{
    "localization_bridge",
    "Makes an unchanged localization node a client of the benchmark: gives "
    "it map, initial pose and scans, reads its poses, submits them.",
    R"(The benchmark's side: problem, target, source, summary; ready, submit_pose; in the namespace /pcrb
unless another is given. Ends when the server says that the run is over.)",
    pcrb::kBridgeParameters};

}  // namespace

int main(int argc, char** argv) {
  return pcrb::runNode(argc, argv, kHelp, [](pcrb::ShutdownRequest& shutdown) {
    const pcrb::BridgeParameters parameters = pcrb::readBridgeParameters();
    return pcrb::LocalizationBridge(parameters, shutdown).run() ? 0 : 1;
  });
}
