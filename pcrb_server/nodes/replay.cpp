#include "replay/replay.hpp"

namespace {

const pcrb::NodeHelp kHelp{"replay",
                           "Shows a sequence, a problem file or a finished run in rviz, scene by "
                           "scene; or plays a sequence to a node under test.",
                           R"(Private parameters (default):
  root              folder in the common layout; with run: instead of the one that the run used
  sequence          a sequence, or data_set/sequence
  problems ()       local or global: the sequence's problems instead of its scans
  run               folder of a run, instead of root and sequence
  rate (2)          scenes per second;  loop (false);  autostart (true)  false: wait for ~start
  keep_alive (false)  stay after the last scene, for who looks later
Of a sequence:
  map_file ()       a cloud in the sequence's frame (a name in its folder or an absolute path)
                    instead of the map that grows;  exclude ()  files that are no scans
  map_leaf (0)      m, edge of the growing map's voxels, 0 = the data set's;  map_points (200000)
                    its limit, beyond which voxels double
  truth (true)      false: only what a node under test may see: the scan in its sensor's frame, the
                    map file, and the initial pose with the first scan
  scan_frame (pcrb_scan)  of the scan without truth;  map_frame (map)
  stamps_file ()    written at the end: which scan was published when, for score_poses --scans
Of a run:
  sequences (all);  order (finished)  finished, worst or best first

Topics: of a sequence map, scan, sensor, path, initialpose; of problems target, source, source_true,
problem, initialpose, markers; of a run target, source, source_aligned, markers; tf.
Services: ~start, ~pause, ~step (std_srvs/Trigger).)"};

}  // namespace

int main(int argc, char** argv) {
  return pcrb::runNode(argc, argv, kHelp, [](pcrb::ShutdownRequest& shutdown) {
    const pcrb::ReplayParameters parameters = pcrb::readReplayParameters();
    pcrb::Replay(parameters, shutdown).run();
    return 0;
  });
}
