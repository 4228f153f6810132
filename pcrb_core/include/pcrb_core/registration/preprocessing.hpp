#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pcrb_core/search/kd_tree.hpp"

namespace pcrb {

/// Points in m.
using Points = std::vector<Eigen::Vector3f>;

/// One point per occupied cell of a grid: the mean of the cell's points (in double, in their
/// order). Cells are ordered by z, y, x, whatever the order of the points.
///
/// @param leaf  edge of a cell, m; cell boundaries are at its multiples.
/// @throws InvalidProblem  if the cloud spans more than 2^21 cells along an axis.
Points voxelGrid(const Points& points, double leaf);

/// A uniformly random part of the points, without replacement, in their order.
///
/// @param fraction  of the points to keep, in (0, 1]; rounded to the nearest count.
Points subsample(const Points& points, double fraction, std::uint64_t seed);

/// Mean of at least one point, in double, in their order, m.
Eigen::Vector3d meanOf(const Points& points);

/// @param what  `source` or `target`, for the message.
/// @throws InvalidProblem  if fewer than `min` points are left.
void requirePoints(const Points& points, std::size_t min, const char* what);

/// Unit normal of each point of a tree, from the covariance of its nearest points, itself included.
/// Their signs are arbitrary.
///
/// @param neighbors  >= 3, at most the number of points.
Points surfaceNormals(const KdTree& tree, std::size_t neighbors, int threads);

/// The same from all points within `radius` (m); zero where they are fewer than 3.
Points surfaceNormalsWithin(const KdTree& tree, double radius, int threads);

}  // namespace pcrb
