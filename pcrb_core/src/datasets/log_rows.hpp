#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/io/text.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

enum class Separator { kBlanks, kComma };

/// All numbers of a line. Blanks around numbers are accepted, and a comma after the last one;
/// nothing else is.
/// @return  false if a part is no number; `numbers` then holds those before it.
bool parseNumbers(std::string_view line, Separator separator, std::vector<double>& numbers);

/// The numbers of the reader's line.
/// @throws InvalidFile  unless there are exactly `count`, all finite.
std::vector<double> requireNumbers(const LineReader& reader, std::string_view line,
                                   Separator separator, std::size_t count,
                                   const std::string& expected);

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
