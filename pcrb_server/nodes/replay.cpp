#include "replay/replay.hpp"

namespace pcrb::replay {
namespace {

const NodeHelp kHelp{
    "replay",
    "Shows a sequence, a problem file or a finished run in rviz, scene by "
    "scene; or plays a sequence to a node under test.",
    R"(Topics: of a sequence map, scan, sensor, path, initialpose; of problems target, source, source_true,
problem, initialpose, markers; of a run target, source, source_aligned, markers; tf.
Services: ~start, ~pause, ~step (std_srvs/Trigger).)",
    kReplayParameters};

}  // namespace

int run(int argc, char** argv) {
  return runNode(argc, argv, kHelp, [](ShutdownRequest& shutdown) {
    const ReplayParameters parameters = readReplayParameters();
    Replay(parameters, shutdown).run();
    return 0;
  });
}

}  // namespace pcrb::replay
