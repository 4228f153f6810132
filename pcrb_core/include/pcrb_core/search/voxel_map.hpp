#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/search/block_table.hpp"

namespace pcrb {

/// Clouds of one frame merged into the centroids of the points in each cubic voxel.
///
/// Memory is bounded by the map, not by what is added: 32 bytes a voxel and 6 to 50 bytes for its
/// entry in the table. The voxels lie on a fixed grid through the frame's origin. The result
/// depends on the order of the clouds in the last digits only.
class VoxelMap {
 public:
  /// @param leaf  edge of a voxel, m, > 0.
  /// @throws InvalidParameter  if it is not positive and finite.
  explicit VoxelMap(double leaf);

  /// @throws InvalidProblem  if a point is 2^30 voxels or more from the frame's origin on any axis.
  void add(const DatasetCloud& cloud);

  std::size_t size() const { return voxels_.size(); }

  /// One point per voxel, in the order in which the voxels were first seen; no viewpoint.
  DatasetCloud cloud() const;

 private:
  struct Voxel {
    Eigen::Vector3d mean;  ///< m, in the data set's frame
    std::uint64_t count;
  };

  double leaf_;
  BlockTable table_;
  std::vector<Voxel> voxels_;
};

}  // namespace pcrb
