#include "verdict/evaluation.hpp"

#include "pcrb_server/node_main.hpp"

namespace pcrb::evaluation_test {
namespace {

const NodeHelp kHelp{"evaluation_test",
                     "Waits for the end of a benchmark run and says whether it kept its "
                     "thresholds; a test node for rostest (pcrb_launch evaluate.test).",
                     R"(Arguments:
  --gtest_output=xml:FILE  JUnit file to write, as rostest asks for; --text is ignored

Topics: summary, result; in the namespace /pcrb unless another is given.
Calls: the server's ~start when it listens, so that no run is over before (autostart false).
Exit status: 0 only if the run finished and every threshold was kept.)",
                     kEvaluationParameters};

}  // namespace

int run(int argc, char** argv) {
  const std::string file = takeJunitFile(argc, argv);
  return runNode(argc, argv, kHelp,
                 [&](ShutdownRequest& shutdown) { return runEvaluation(file, shutdown); });
}

}  // namespace pcrb::evaluation_test
