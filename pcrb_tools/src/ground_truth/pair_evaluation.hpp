#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/registration/registration.hpp"
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
  std::vector<double> translations;   ///< m, of the same
  std::vector<double> rotations_deg;  ///< of the same
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

/// The same of a text that is in memory already.
PairFile parsePairFile(const std::string& text, const std::string& path);

/// The header of the published files.
std::string_view publishedPairHeader();

/// Aligns pairs of a sequence's clouds from their ground-truth poses. A target that stays is read
/// and prepared once.
class PairEvaluator {
 public:
  /// @param radius  m: pairs of points beyond are no pairs.
  PairEvaluator(std::string folder, double radius, int threads);

  /// Adds the pair's row: PPCR on all points with 10 neighbours, Student's t with ν = 5, no ρ, no
  /// quantile cut; its misalignment is the metric's unnormalized variant of what PPCR moved.
  /// A pair that cannot be aligned, say for too few points, becomes a row with the reason.
  /// @throws pcrb::InvalidFile  if a cloud cannot be read.
  void evaluate(const PairNames& pair, PairFile& file);

 private:
  void setTarget(const std::string& name);
  void align(const PairNames& pair, PairFile& file);

  std::string folder_;
  std::unique_ptr<pcrb::Registration> method_;
  std::string target_;  // the method's, a file name; empty without one
  Eigen::Vector3d local_origin_ = Eigen::Vector3d::Zero();
};

}  // namespace pcrb_tools
