#include "replay/replay.hpp"

namespace {

const pcrb::NodeHelp kHelp{
    "replay",
    "Shows a sequence, a problem file or a finished run in rviz, scene by "
    "scene; or plays a sequence to a node under test.",
    R"(Topics: of a sequence map, scan, sensor, path, initialpose; of problems target, source, source_true,
problem, initialpose, markers; of a run target, source, source_aligned, markers; tf.
Services: ~start, ~pause, ~step (std_srvs/Trigger).)",
    pcrb::kReplayParameters};

}  // namespace

int main(int argc, char** argv) {
  return pcrb::runNode(argc, argv, kHelp, [](pcrb::ShutdownRequest& shutdown) {
    const pcrb::ReplayParameters parameters = pcrb::readReplayParameters();
    pcrb::Replay(parameters, shutdown).run();
    return 0;
  });
}
