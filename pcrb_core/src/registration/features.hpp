#pragma once

#include <array>
#include <memory>
#include <vector>

#include "pcrb_core/registration/parameters.hpp"
#include "pcrb_core/registration/preprocessing.hpp"
#include "pcrb_core/search/kd_tree.hpp"

namespace pcrb {

constexpr std::size_t kFpfhBins = 11;
constexpr std::size_t kFpfhSize = 3 * kFpfhBins;

/// Fast point feature histogram: three histograms of kFpfhBins, each of which sums to 100.
using Fpfh = std::array<float, kFpfhSize>;

/// Features of a cloud's points, for those that have one.
struct FpfhCloud {
  Points points;  ///< m
  std::vector<Fpfh> features;
};

/// Features of a tree's points. Those whose normal or feature is not defined (fewer than 3 points
/// within the normal radius, no other point with a normal within the feature radius) are left out.
///
/// Normals point towards the cloud's centroid, so that features turn with the cloud. The same bits
/// on every processor and at any thread count.
/// Source: Rusu, Blodow, Beetz, Fast point feature histograms (FPFH) for 3D registration, ICRA
/// 2009; bins and weights (1 / squared distance) as in PCL.
FpfhCloud computeFpfh(const KdTree& tree, double normal_radius, double feature_radius, int threads);

/// What the methods on features read alike.
struct FeatureParameters {
  explicit FeatureParameters(ParameterReader& reader);

  double voxel_leaf;             ///< m
  double normal_radius_leaves;   ///< radius for normals, × voxel_leaf
  double feature_radius_leaves;  ///< radius for features, × voxel_leaf
  int threads;
};

/// Points that may be the same place: source[i] and target[i], m.
struct Matches {
  Points source;
  Points target;

  std::size_t size() const { return source.size(); }
};

/// Matches points of two clouds that are each other's nearest in feature space. The target's
/// features and their search index are kept.
class FeatureMatcher {
 public:
  explicit FeatureMatcher(const FeatureParameters& parameters);
  ~FeatureMatcher();
  FeatureMatcher(FeatureMatcher&&) noexcept;
  FeatureMatcher& operator=(FeatureMatcher&&) noexcept;

  /// @throws InvalidProblem  if fewer than 3 points have a feature.
  void setTarget(const Points& target);

  /// In the order of the source's filtered points.
  ///
  /// @throws InvalidProblem      if fewer than 3 source points have a feature.
  /// @throws RegistrationFailed  if there are fewer than 3 matches.
  Matches match(const Points& source) const;

 private:
  class Index;
  FpfhCloud describe(const Points& points, const char* what) const;

  FeatureParameters parameters_;
  std::unique_ptr<Index> target_;
};

/// Weighted orthogonal Procrustes: the rigid transform with the least Σ w ‖target − T source‖²; the
/// identity where no weight is positive.
Transform fitRigid(const Matches& matches, const std::vector<double>& weights);

}  // namespace pcrb
