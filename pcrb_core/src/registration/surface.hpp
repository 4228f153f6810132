#pragma once

#include <cstddef>

#include "pcrb_core/registration/preprocessing.hpp"
#include "pcrb_core/search/kd_tree.hpp"

namespace pcrb {

/// Unit normal of each point of a tree, from the covariance of its nearest points, itself included.
/// Their signs are arbitrary.
///
/// @param neighbors  >= 3, at most the number of points.
Points surfaceNormals(const KdTree& tree, std::size_t neighbors, int threads);

/// The same from all points within `radius` (m); zero where they are fewer than 3.
Points surfaceNormalsWithin(const KdTree& tree, double radius, int threads);

}  // namespace pcrb
