#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "pcrb_core/problem/frame_offset.hpp"

namespace pcrb {

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
