#include "supervisor/node_supervisor.hpp"

#include "pcrb_server/node_main.hpp"

namespace pcrb::node_supervisor {
namespace {

const NodeHelp kHelp{
    "node_supervisor",
    "Runs a launch file as a child and starts it anew when it dies or when "
    "localization_bridge asks for that.",
    R"(Service: ~restart (std_srvs/Trigger) ends the child and all that it started (SIGINT, 5 s later SIGTERM,
2 s later SIGKILL), then starts it. A child that ends by itself is started anew; one that does so within
10 s three times in a row, without a result of the server between, is an error. It runs outside the
supervisor's namespace. The supervisor ends with the process that started it, as when roslaunch is killed.)",
    kSupervisorParameters};

}  // namespace

int run(int argc, char** argv) {
  return runNode(argc, argv, kHelp, [](ShutdownRequest& shutdown) {
    const auto parameters = readSupervisorParameters();
    describeLaunch(parameters, shutdown);
    NodeSupervisor(parameters, shutdown).run();
    return 0;
  });
}

}  // namespace pcrb::node_supervisor
