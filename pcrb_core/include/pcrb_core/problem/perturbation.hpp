#pragma once

#include <Eigen/Core>

#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// Rotation about a centre, then a translation: Trans(c) · Trans(t) · R · Trans(−c).
/// Source: Fontana et al. 2021, section 3.1.
Transform makePerturbation(const Eigen::Vector3d& center, const Eigen::Vector3d& translation,
                           const Eigen::Matrix3d& rotation);

/// How far a perturbation of a data set may move the source's centroid, m: its bound × 1.1 + 0.2.
double maxCentroidMotion(const PerturbationBounds& bounds);

/// Checks that a perturbation moves the source's centroid no farther than its data set's bound
/// allows (maxCentroidMotion): else the clouds are in another frame than the problem file's.
///
/// @param source_centroid  m, in the data set's frame.
/// @throws InvalidProblem  saying how far the centroid moves, the bound, and the likely cause.
void checkFrame(const Transform& P, const Eigen::Vector3d& source_centroid,
                const PerturbationBounds& bounds);

}  // namespace pcrb
