#pragma once

#include <memory>
#include <string>

#include "ground_truth/pair_file.hpp"
#include "pcrb_core/registration/registration.hpp"

namespace pcrb_tools {

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
