#include <ros/callback_queue.h>

#include "benchmarking/method_choice.hpp"
#include "benchmarking/registration_client.hpp"
#include "pcrb_server/node_main.hpp"
#include "pcrb_server/node_parameters.hpp"

namespace pcrb_tools::registration_node {
namespace {

const pcrb::NodeHelp kHelp{
    "registration_node",
    "Solves the benchmark's problems with a registration method: subscribes, aligns, submits.",
    R"(Sets the parameter ~in_effect itself: all parameters of the method, and the plugin's hash. A run
goes on only under the same.

Topics and services: problem, target, source, summary; ready, submit_pose; in the namespace /pcrb
unless another is given. Ends when the server says that the run is over.)",
    MethodChoice::parameters()};

int solve(pcrb::ShutdownRequest& shutdown) {
  pcrb::NodeParameters reader(MethodChoice::parameters());
  const MethodChoice method(reader);
  reader.finish();
  method.announce();  // before the first `ready`, when the server reads it
  RegistrationClient client([&](const pcrb_msgs::Problem& problem) {
    return method.make(problem.data_set, problem.voxel_leaf);
  });
  const ros::WallDuration period(0.1);
  while (!client.finished() && !shutdown.requested()) {
    ros::getGlobalCallbackQueue()->callAvailable(period);
  }
  return client.finished() ? 0 : 1;
}

}  // namespace

int run(int argc, char** argv) { return pcrb::runNode(argc, argv, kHelp, solve); }

}  // namespace pcrb_tools::registration_node
