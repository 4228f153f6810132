#pragma once

#include <memory>
#include <optional>

#include "pcrb_core/registration/parameter_reader.hpp"
#include "pcrb_core/registration/preprocessing.hpp"
#include "registration/fpfh.hpp"

namespace pcrb {

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
