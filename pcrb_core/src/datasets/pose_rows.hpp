#pragma once

#include <Eigen/Core>
#include <string>

#include "datasets/number_rows.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// Largest ‖RᵀR − I‖ (Frobenius) of a rotation in a log: six decimals are far within it, a matrix
/// that means something else is not.
constexpr double kLogRotationTolerance = 1e-3;

/// The transform of [R | t] as a log has it, R kept as it is.
///
/// @throws InvalidFile  for the reader's line unless R is a rotation within kLogRotationTolerance.
Transform requireLogPose(const LineReader& reader, const Eigen::Matrix<double, 3, 4>& rows);

/// The transform of 16 row-major numbers.
/// @throws InvalidFile  also unless the last four are 0 0 0 1.
Transform requireLogPose4x4(const LineReader& reader, const double* numbers);

}  // namespace pcrb
