#include "server/benchmark_server.hpp"

#include "pcrb_server/node_main.hpp"

namespace {

const pcrb::NodeHelp kHelp{"benchmark_server",
                           "Hands registration problems to the node under test, one after the "
                           "other, and scores its replies.",
                           R"(Private parameters (default):
  root              folder in the common layout: <root>/<data set>/<sequence>_<kind>.txt and clouds
  run               folder of the results; with results of the same configuration the run goes on
  under_test ()     name of what is benchmarked; a run goes on only under the same, and with a client
                    of the same private parameters and, if this is empty, of the same node name
  sequences (all)   sequences, data sets or data_set/sequence, separated by blanks
  kind (local)      local, global or both
  presentation (registration)  registration or localization
  subset (0)        number of problems drawn over all sequences, 0 = all;  seed (1) of that draw
  shard (0/1)       i/N: serve the i-th of N disjoint parts
  time_limit (10)   s from a source's publication to its reply
  handshake (ready) ready: a client calls `ready`;  none: whoever subscribes to `problem`, by any name
  connect_limit (60), ready_limit (60)  s to wait for the first `ready`, for each further one
  global_guess (false)  give an initial guess for global problems too
  upright (false)   localization without VIEWPOINT: turn scans about z only; gives the tilt away
  autostart (true)  false: wait for ~start
  linger (5)        s that the summary stays up at the end, unless its readers have left before
  cache_memory_mb (2048), load_threads (1)
  map_frame (map), scan_frame (pcrb_scan), publish_tf (true)
  debug (false)     publish the truth on debug/*; marks the run

Topics and services: target, source, problem, initialpose, result, summary, source_aligned, markers;
ready, submit_pose, ~start, ~pause, ~skip; in the namespace /pcrb unless another is given.
Exit status: 0 only if every problem has a result.)"};

}  // namespace

int main(int argc, char** argv) {
  return pcrb::runNode(argc, argv, kHelp, [](pcrb::ShutdownRequest& shutdown) {
    const pcrb::ServerParameters parameters = pcrb::readServerParameters();
    pcrb::BenchmarkServer server(parameters, shutdown);
    return server.run() ? 0 : 1;
  });
}
