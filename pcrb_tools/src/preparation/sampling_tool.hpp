#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pcrb_core/problem/dataset.hpp"

namespace pcrb_tools {

/// What `sample_problems` is asked for.
struct SamplingOptions {
  std::string folder;   ///< `<root>/<data set>/<sequence>`
  std::string overlap;  ///< overlap matrix; empty = `<folder>_overlap.txt`
  std::string map;      ///< every cloud against this one instead of pair sampling; empty = sampling
  std::string sequence;  ///< name in files and ids; empty = the folder's, or `planetary_map`
  std::vector<pcrb::Kind> kinds{pcrb::Kind::kLocal, pcrb::Kind::kGlobal};
  std::vector<std::string> excluded;  ///< clouds that pairs are not drawn from; kMapCloud never is
  pcrb::BoundsSource bounds = pcrb::BoundsSource::kMeasured;
  std::uint64_t seed = 1;
  int threads = 1;
  bool force = false;  ///< replace outputs that somebody else made
};

/// Draws the registration problems of a sequence and writes `<sequence>_local.txt` and
/// `<sequence>_global.txt` beside its folder, each with a side file that records the seed.
///
/// An output that is complete and unchanged is kept.
/// @throws pcrb::Error  if clouds, matrix, parameters or outputs are not as they should be.
void runSamplingTool(const SamplingOptions& options);

}  // namespace pcrb_tools
