#pragma once

#include <cstdint>
#include <string>

namespace pcrb_tools {

/// What the demo benchmarks: the data set `demo` with the sequence `hall` and its two lists.
struct DemoSequence {
  std::uint64_t seed = 1;
  std::size_t scans = 10;
  std::size_t pairs = 4;  ///< per list; a local pair has 30 problems, a global pair one
};

/// Simulates a scanner that is carried through a furnished hall and writes its scans and problems
/// in the common layout: `<root>/demo/hall/*.pcd`, `hall_local.txt` and `hall_global.txt`.
///
/// Scans are in ground-truth pose, with the sensor's pose as VIEWPOINT. Scene, noise, pairs and
/// perturbations are drawn from the seed: same seed, same bytes.
/// @throws InvalidFile  if a file cannot be written.
void makeDemoSequence(const std::string& root, const DemoSequence& demo);

}  // namespace pcrb_tools
