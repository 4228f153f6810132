#pragma once

#include <cstddef>

#include "pcrb_core/search/voxel_map.hpp"

namespace pcrb {

/// A voxelised map that grows by clouds but not beyond a number of points: whenever there are more,
/// voxels become twice as long.
class BoundedMap {
 public:
  /// @param leaf    edge of a voxel at first, m, > 0.
  /// @param limit   points, > 0.
  /// @throws InvalidParameter  if either is not so.
  BoundedMap(double leaf, std::size_t limit);

  /// @throws InvalidProblem  as VoxelMap.
  void add(const DatasetCloud& cloud);

  DatasetCloud cloud() const { return map_.cloud(); }
  std::size_t size() const { return map_.size(); }
  double leaf() const { return leaf_; }  ///< m

 private:
  double leaf_;
  std::size_t limit_;
  VoxelMap map_;
};

}  // namespace pcrb
