#pragma once

#include <cstddef>

namespace pcrb {

/// Whether one of n points is strictly closer to p than the square root of `squared_distance`.
///
/// The squared distance is (dx² + dy²) + dz² in double, rounded after every operation, as k-d trees
/// in double have it: decisions are equal to theirs to the last bit.
bool anyCloser(const double* x, const double* y, const double* z, std::size_t n, const double* p,
               double squared_distance);

}  // namespace pcrb
