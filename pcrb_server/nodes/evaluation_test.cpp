#include "pcrb_server/node_main.hpp"
#include "verdict/evaluation_node.hpp"

namespace {

const pcrb::NodeHelp kHelp{"evaluation_test",
                           "Waits for the end of a benchmark run and says whether it kept its "
                           "thresholds; a test node for rostest (pcrb_launch evaluate.test).",
                           R"(Private parameters (default):
  max_median, max_q95    largest error allowed: `0.1` for every sequence and the total,
                         `0.1 hall=0.5 hall:global=0.8` with others for some; none: no limit
  min_replied (1)        least fraction of problems with a valid reply, in the same form
  time_limit_total (3600)  s from this node's start to the end of the run
  server (benchmark_server)  name of the server's node
  clients                names of nodes without which no problem is solved: if one ends before the
                         run, or does not start, so does this
  run                    folder of the results, to be named in the report

Arguments:
  --gtest_output=xml:FILE  JUnit file to write, as rostest asks for; --text is ignored

Topics: summary, result; in the namespace /pcrb unless another is given.
Calls: the server's ~start when it listens, so that no run is over before (autostart false).
Exit status: 0 only if the run finished and every threshold was kept.)"};

}  // namespace

int main(int argc, char** argv) {
  const std::string file = pcrb::takeJunitFile(argc, argv);
  return pcrb::runNode(argc, argv, kHelp, [&](pcrb::ShutdownNotice& shutdown) {
    return pcrb::runEvaluation(file, shutdown);
  });
}
