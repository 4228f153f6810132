#include "server/benchmark_server.hpp"

#include "pcrb_server/node_main.hpp"

namespace pcrb::benchmark_server {
namespace {

const NodeHelp kHelp{
    "benchmark_server",
    "Hands registration problems to the node under test, one after the "
    "other, and scores its replies.",
    R"(Topics and services: target, source, problem, initialpose, result, summary, source_aligned, markers;
ready, submit_pose, ~start, ~pause, ~skip; in the namespace /pcrb unless another is given.
Exit status: 0 only if every problem has a result and none was skipped.)",
    kServerParameters};

}  // namespace

int run(int argc, char** argv) {
  return runNode(argc, argv, kHelp, [](ShutdownRequest& shutdown) {
    const ServerParameters parameters = readServerParameters();
    BenchmarkServer server(parameters, shutdown);
    return server.run() ? 0 : 1;
  });
}

}  // namespace pcrb::benchmark_server
