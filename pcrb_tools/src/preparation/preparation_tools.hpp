#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"

namespace pcrb_tools {

/// What `build_map` is asked for.
struct MapOptions {
  std::string folder;          ///< `<root>/<data set>/<sequence>`
  std::string output;          ///< the map, a PCD file
  std::optional<double> leaf;  ///< edge of a voxel, m; empty = the data set's
  std::vector<std::string> excluded;
  int threads = 1;
  bool force = false;  ///< replace an output that somebody else made
};

/// Merges the clouds of a sequence, which are in the world frame, into the centroids of voxels.
///
/// Memory is bounded by the map and by one cloud per thread. The map's bytes do not depend on the
/// threads. An output that is complete and unchanged is kept.
/// @throws pcrb::Error  if a cloud, the data set's parameters or the output is not as it should be.
void runMapTool(const MapOptions& options);

/// What `compute_overlap` is asked for.
struct OverlapOptions {
  std::string folder;                ///< `<root>/<data set>/<sequence>`
  std::string output;                ///< empty = `<folder>_overlap.txt`
  std::optional<double> distance;    ///< m; empty = the data set's
  std::size_t window = 0;            ///< 0 = all ordered pairs
  std::vector<std::string> targets;  ///< empty = all
  std::vector<std::string> excluded;
  int threads = 1;
  bool force = false;  ///< replace an output that somebody else made
};

/// Computes the overlap matrix of a sequence and writes it in the published text format.
///
/// Targets that are done are kept in `<output>.partial`, from which an interrupted run goes on; an
/// output that is complete and unchanged is kept.
/// @throws pcrb::Error  if a cloud, the data set's parameters or the output is not as it should be.
void runOverlapTool(const OverlapOptions& options);

/// What `sample_problems` is asked for.
struct SamplingOptions {
  std::string folder;   ///< `<root>/<data set>/<sequence>`
  std::string overlap;  ///< overlap matrix; empty = `<folder>_overlap.txt`
  std::string map;      ///< every cloud against this one instead of pair sampling; empty = sampling
  std::string sequence;  ///< name in files and ids; empty = the folder's, or `planetary_map`
  std::vector<pcrb::Kind> kinds{pcrb::Kind::kLocal, pcrb::Kind::kGlobal};
  std::vector<std::string> excluded;  ///< clouds that pairs are not drawn from; kMapCloud never is
  pcrb::BoundsSource bounds = pcrb::BoundsSource::kMeasured;
  pcrb::TopUp top_up = pcrb::TopUp::kEven;
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

/// What `import_protocol` is asked for.
struct ProtocolOptions {
  std::string protocol;  ///< `<sequence>_protocol.csv`
  std::string folder;    ///< `<root>/<data set>/<sequence>`, clouds with VIEWPOINT
  std::string output;    ///< problem file
  int threads = 1;
  bool force = false;  ///< replace an output that somebody else made
};

/// Makes a problem file of the original ETH protocol: reading becomes source, reference target, and
/// the perturbation is what puts the source, in ground-truth pose, where the protocol begins:
/// P = T_world_reference · T_initial · T_world_reading^-1 for scans in their own frames, T_initial
/// for those in the world's. Overlaps are computed by the data set's distance. Identical problems
/// are taken once.
///
/// @throws pcrb::Error  if the protocol is malformed, a cloud is not there or has no VIEWPOINT.
void runProtocolImport(const ProtocolOptions& options, std::ostream& out);

/// What `check_dataset` is asked for.
struct CheckOptions {
  std::string root;                    ///< folder of data sets in the common layout
  std::vector<std::string> sequences;  ///< words of pcrb::namesSequence; empty = all
  std::size_t overlap_pairs = 5;       ///< pairs of each problem file whose overlap is recomputed
  bool strict = false;                 ///< warnings count as errors
  int threads = 1;
};

/// Checks data sets in the common layout, folders of clouds without problem files included, and
/// prints one line per finding, `error: file: what`, and
/// a last line with the counts.
///
/// @return  whether no error was found (with `strict`, nor a warning).
/// @throws pcrb::Error  if the root is no folder, holds neither problem files nor clouds, or a
///                      wanted sequence is not there.
bool runCheckTool(const CheckOptions& options, std::ostream& out);

}  // namespace pcrb_tools
