#pragma once

#include <cstdint>

#include "pcrb_core/registration/parameter_reader.hpp"
#include "pcrb_core/registration/preprocessing.hpp"

namespace pcrb {

/// What ICP and G-ICP read alike; the paper's values are the defaults.
struct IcpParameters {
  explicit IcpParameters(ParameterReader& reader)
      : voxel_leaf(reader.positive("voxel_leaf", 0.2)),
        sampling_fraction(reader.number("sampling_fraction", 0.7, 1e-6, 1.0)),
        rejection_factor(reader.number("rejection_factor", 3.0, 1.0)),
        max_iterations(reader.integer("max_iterations", 35, 1)),
        translation_epsilon(reader.number("translation_epsilon", 0.01, 0.0)),
        seed(reader.seed("seed", 1)),
        threads(reader.threads()) {}

  Points filterTarget(const Points& points) const { return voxelGrid(points, voxel_leaf); }
  Points filterSource(const Points& points) const {
    return subsample(voxelGrid(points, voxel_leaf), sampling_fraction, seed);
  }

  double voxel_leaf;           ///< m
  double sampling_fraction;    ///< part of the filtered source that is used
  double rejection_factor;     ///< × the median distance; pairs beyond are left out
  int max_iterations;          ///< then the method stops unconverged
  double translation_epsilon;  ///< m, at the source's centroid; a smaller step is convergence
  std::uint64_t seed;          ///< of the subsampling
  int threads;
};

}  // namespace pcrb
