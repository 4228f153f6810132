#pragma once

#include <array>

#include "pcrb_core/registration/preprocessing.hpp"
#include "pcrb_core/search/kd_tree.hpp"

namespace pcrb {

constexpr std::size_t kFpfhBins = 11;
constexpr std::size_t kFpfhSize = 3 * kFpfhBins;

/// Fast point feature histogram: three histograms of kFpfhBins, each of which sums to 100.
using Fpfh = std::array<float, kFpfhSize>;

/// Features of a cloud's points, for those that have one.
struct FpfhCloud {
  Points points;  ///< m
  std::vector<Fpfh> features;
};

/// Features of a tree's points. Those whose normal or feature is not defined (fewer than 3 points
/// within the normal radius, no other point with a normal within the feature radius) are left out.
///
/// Normals point towards the cloud's centroid, so that features turn with the cloud. The same bits
/// on every processor and at any thread count.
/// Source: Rusu, Blodow, Beetz, Fast point feature histograms (FPFH) for 3D registration, ICRA
/// 2009; bins and weights (1 / squared distance) as in PCL.
FpfhCloud computeFpfh(const KdTree& tree, double normal_radius, double feature_radius, int threads);

}  // namespace pcrb
