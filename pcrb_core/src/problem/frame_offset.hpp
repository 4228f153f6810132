#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "pcrb_core/transform.hpp"

namespace pcrb {

/// A perturbation and the centroid of the cloud that it is for, m.
struct PerturbedCentroid {
  Transform P = Transform::Identity();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
};

/// The shift between the frame of clouds and the frame of a problem file.
struct FrameOffset {
  Eigen::Vector3d offset;          ///< m: p_problem_file = p_clouds + offset
  Eigen::Vector3d standard_error;  ///< m, per axis
  double residual;                 ///< m, root mean square of a centroid's motion with the offset
};

/// Estimates the one offset o that would make all perturbations rotate about their centroids: least
/// squares over (R − I)(c + o) + p, which is then the sampled translation, whose mean is zero.
///
/// @throws InvalidProblem  if the rotations do not determine the offset (fewer than two
/// perturbations,
///                         or all about one axis).
FrameOffset estimateFrameOffset(const std::vector<PerturbedCentroid>& rows);

/// `3 of 45`.
std::string outOf(std::size_t some, std::size_t all);

/// How far a row's perturbation moves its centroid, shifted by an offset, m.
double centroidMotion(const PerturbedCentroid& row, const Eigen::Vector3d& offset);

/// What shift of the clouds would bring all centroid motions below a limit (m), in words.
std::string explainOffset(const std::vector<PerturbedCentroid>& rows, double max_motion);

/// Where the centroids of the clouds lie that a problem file was made with, in words; from rows by
/// source, with centroids at zero: all rows of a source rotate about its centroid. Empty where no
/// source has rows enough.
std::string describeCentroids(const std::map<std::string, std::vector<PerturbedCentroid>>& rows_of);

}  // namespace pcrb
