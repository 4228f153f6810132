#pragma once

namespace pcrb_tools {

/// Whether the command line has `--live`, which makes a converter a node; it is taken away.
bool takeLiveFlag(int& argc, char** argv);

/// `tum_to_pcd --live`: converts what is published, with the parameters that `--live --help` lists,
/// until it is interrupted or idle. Returns the exit status.
int runTumNode(int argc, char** argv);

/// The same for `kaist_to_pcd --live`.
int runKaistNode(int argc, char** argv);

}  // namespace pcrb_tools
