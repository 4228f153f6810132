#include <ros/callback_queue.h>
#include <ros/package.h>

#include "pcrb_core/registration/method_parameters.hpp"
#include "pcrb_core/registration/registry.hpp"
#include "pcrb_server/node_main.hpp"
#include "pcrb_server/node_parameters.hpp"
#include "pcrb_tools/registration_client.hpp"

namespace {

const pcrb::NodeHelp kHelp{
    "registration_node",
    "Solves the benchmark's problems with a registration method: subscribes, aligns, submits.",
    R"(Private parameters (default):
  method (gicp)     icp, gicp, … (a wrong name lists them all)
  plugin            shared library with methods of your own, loaded before the method is looked up
  parameters        YAML file of the method's parameters
                    (config/methods/<method>.yaml of the package pcrb_launch: the paper's)

Topics and services: problem, target, source, summary; ready, submit_pose; in the namespace /pcrb
unless another is given. Ends when the server says that the run is over.)"};

int run(pcrb::ShutdownNotice& shutdown) {
  pcrb::NodeParameters reader;
  const std::string method = reader.string("method", "gicp");
  const std::string file = reader.string(
      "parameters", ros::package::getPath("pcrb_launch") + "/config/methods/" + method + ".yaml");
  const auto make = [&](const std::string& data_set) {
    return pcrb::makeRegistration(method, pcrb::loadMethodParameters(file, data_set));
  };
  const std::string plugin = reader.string("plugin", "");
  reader.check([&] {
    if (!plugin.empty()) pcrb::loadRegistrationLibrary(plugin);
    make("");
  });
  reader.finish();
  pcrb_tools::RegistrationClient client(make);
  const ros::WallDuration period(0.1);
  while (!client.finished() && !shutdown.requested()) {
    ros::getGlobalCallbackQueue()->callAvailable(period);
  }
  return client.finished() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) { return pcrb::runNode(argc, argv, kHelp, run); }
