#pragma once

#include <cstddef>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// How far an estimated pose is from the true one.
struct PoseError {
  double error = 0.0;              ///< the benchmark's metric, dimensionless, >= 0
  double rotation_error = 0.0;     ///< rad, in [0, π]
  double translation_error = 0.0;  ///< m, at the source's centroid
};

/// The benchmark's metric for one source cloud. Everything that depends on the source alone is
/// computed once, on construction; the object keeps a copy of what it needs.
///
/// Points within 1e-9 m of the centroid carry no weight and are left out of sum and n.
/// Results are finite, in double, and the same bits on every processor.
/// Source: Fontana et al. 2021, eq. 1.
class Metric {
 public:
  /// @param source  at ground truth, relative to its local origin.
  /// @throws InvalidProblem  if no point carries weight.
  explicit Metric(const PointCloud& source);

  /// @param T_residual  estimated pose composed with what was applied, in the source's local frame;
  ///                    identity is perfect.
  PoseError evaluate(const Transform& T_residual) const;

  /// Mean distance between each point and its image, m: for ground-truth evaluation.
  double unnormalized(const Transform& T_residual) const;

  const Eigen::Vector3d& centroid() const { return centroid_; }  ///< m, relative to local origin
  std::size_t weighted() const { return weighted_; }             ///< points that carry weight
  std::size_t weightless() const { return weightless_; }         ///< points at the centroid

 private:
  Eigen::Vector3d centroid_;
  std::size_t weighted_ = 0;
  std::size_t weightless_ = 0;
};

}  // namespace pcrb
