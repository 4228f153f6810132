#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pcrb_core/transform.hpp"

namespace pcrb_tools {

/// A file with a row per pair of clouds:
/// `misalignment_m,tx,ty,tz,qx,qy,qz,qw,source,target,reason`.
///
/// The pose is what is left of the ground truth, its translation (m) that of the source's centroid;
/// both are empty where the pair could not be aligned, which `reason` explains. Published files
/// have the first eight columns only (and their translations are those of the frame's origin).
struct PairFile {
  std::string text;                   ///< header and rows
  std::vector<double> misalignments;  ///< m, of the pairs that were aligned
  std::size_t failed = 0;             ///< pairs that were not

  std::size_t pairs() const { return misalignments.size() + failed; }
};

/// A file without rows yet.
PairFile emptyPairFile();

/// One row's pair, by file names.
struct PairNames {
  std::string source, target;
};

/// @param remark  empty, or that the method did not converge.
void addAligned(PairFile& file, const PairNames& pair, double misalignment,
                const pcrb::Transform& moved, const std::string& remark);
void addFailed(PairFile& file, const PairNames& pair, const std::string& reason);

/// Reads what addAligned and addFailed made, or a published file.
/// @throws pcrb::InvalidFile  with file and line, what was found and what was expected.
PairFile readPairFile(const std::string& path);

}  // namespace pcrb_tools
