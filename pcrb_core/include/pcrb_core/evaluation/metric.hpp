#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// How far an estimated pose is from the true one.
struct PoseError {
  double error = 0.0;              ///< the benchmark's metric, dimensionless, >= 0
  double rotation_error = 0.0;     ///< rad, in [0, π]
  double translation_error = 0.0;  ///< m, at the source's centroid
};

/// The benchmark's metric for one source cloud, δ = (1/n) Σ ‖p_i − g_i‖ / ‖p_i − p̄‖ with g_i the
/// source's points at ground truth, p_i = T_residual · g_i and p̄ the centroid of the p_i.
///
/// A rigid transform keeps ‖p_i − p̄‖, so the weights are computed once, on construction; the object
/// keeps a copy of what it needs. Points within 1e-9 m of the centroid carry no weight and are left
/// out of sum and n.
///
/// δ is a mean of distances: 0 for the identity, the same for T and T⁻¹, δ(A · B) ≤ δ(A) + δ(B).
/// Results are finite (at most the largest double), in double, and the same bits on every
/// processor. Const members may be called from several threads. Source: Fontana et al. 2021, eq. 1.
class Metric {
 public:
  /// @param source  at ground truth, relative to its local origin.
  /// @throws InvalidProblem  if no point carries weight (no points, one point, all at one place),
  /// or
  ///                         a coordinate is not finite.
  explicit Metric(const PointCloud& source);

  /// @param T_residual  estimated pose composed with what was applied, in the source's local frame;
  ///                    identity is perfect.
  /// @throws InvalidProblem  if T_residual is not finite, or not rigid (requireRigid).
  PoseError evaluate(const Transform& T_residual) const;

  /// Mean distance between each point and its image, m, over all points: for ground-truth
  /// evaluation.
  /// @throws InvalidProblem  as evaluate().
  double unnormalized(const Transform& T_residual) const;

  const Eigen::Vector3d& centroid() const { return centroid_; }  ///< m, relative to local origin
  std::size_t weighted() const { return weighted_; }             ///< points that carry weight
  std::size_t weightless() const { return size_ - weighted_; }   ///< points at the centroid

 private:
  Eigen::Vector3d centroid_;
  std::size_t size_ = 0;
  std::size_t weighted_ = 0;
  std::array<std::vector<float>, 3> axes_;  ///< x, y, z as given, padded with zeros
  std::vector<double> weights_;             ///< 1/m, padded with zeros; 0 at the centroid
};

/// What is wrong with a pose along and about each axis of the data set's frame.
struct PoseComponents {
  Eigen::Vector3d translation;  ///< m, of the source's centroid
  double roll = 0.0;            ///< rad, in (−π, π]
  double pitch = 0.0;           ///< rad, in [−π/2, π/2]
  double yaw = 0.0;             ///< rad, in (−π, π]

  /// x, y, z, roll, pitch, yaw.
  std::array<double, 6> values() const {
    return {translation.x(), translation.y(), translation.z(), roll, pitch, yaw};
  }
};

/// Components of T_residual, R = Rz(yaw) · Ry(pitch) · Rx(roll); at pitch ±π/2 roll is 0.
///
/// @param centroid  of the source at ground truth, m, in T_residual's frame.
PoseComponents poseComponents(const Transform& T_residual, const Eigen::Vector3d& centroid);

}  // namespace pcrb
