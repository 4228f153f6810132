#pragma once

#include <Eigen/Geometry>

namespace pcrb {

/// Rigid transform in double. A variable's name says its frames: p_target = T_target_source ·
/// p_source.
/// Not aligned to vector registers: it passes between libraries, and Eigen's alignment depends on
/// the processor that a library was compiled for (-march=native), at the price of no speed that
/// counts.
using Transform = Eigen::Transform<double, 3, Eigen::Isometry, Eigen::DontAlign>;

/// Tolerance of requireRigid: the largest ‖RᵀR − I‖ (Frobenius) of a rigid transform.
constexpr double kRigidTolerance = 1e-6;

constexpr double kRadiansPerDegree = 0.017453292519943295;
constexpr double kDegreesPerRadian = 57.29577951308232;

/// Transform of the first three rows [R | t] of a 4 × 4 matrix, row-major entries, R kept as it is.
///
/// @throws InvalidProblem  if an entry is not finite, ‖RᵀR − I‖ > kRigidTolerance, or det R < 0.
Transform requireRigid(const Eigen::Matrix<double, 3, 4>& rows);

/// Transform of a translation (m) and a quaternion, which is normalised.
///
/// @throws InvalidProblem  if an entry is not finite or the quaternion's norm is below 1e-9.
Transform makeTransform(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation);

/// The rotation nearest to a matrix in the Frobenius norm (SVD), with det = +1.
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& matrix);

/// Expresses a transform of data set coordinates in coordinates relative to `local_origin`:
/// Trans(−o) · T · Trans(o). The translation is the exact one of T's stored entries, rounded once,
/// however large terms cancel; it is what T does to the origin, T · o − o.
Transform inLocalFrame(const Transform& T, const Eigen::Vector3d& local_origin);

/// Angle of a rotation in rad, in [0, π]; accurate near 0 and near π.
double rotationAngle(const Eigen::Matrix3d& R);

}  // namespace pcrb
