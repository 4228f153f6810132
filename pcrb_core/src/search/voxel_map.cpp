#include "pcrb_core/search/voxel_map.hpp"

#include <cmath>
#include <sstream>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr double kMaxVoxels = 1 << 30;

std::int32_t voxelCoordinate(double coordinate, double leaf) {
  const double voxel = std::floor(coordinate / leaf);
  if (!(std::abs(voxel) < kMaxVoxels)) {
    std::ostringstream message;
    message << "found a coordinate of " << coordinate << " m, expected less than "
            << kMaxVoxels * leaf << " m with voxels of " << leaf << " m";
    throw InvalidProblem(message.str());
  }
  return static_cast<std::int32_t>(voxel);
}

}  // namespace

VoxelMap::VoxelMap(double leaf) : leaf_(leaf) {
  if (!(leaf > 0.0) || !std::isfinite(leaf)) {
    throw InvalidParameter("voxel leaf: found " + std::to_string(leaf) +
                           " m, expected more than 0");
  }
}

void VoxelMap::add(const DatasetCloud& cloud) {
  for (const Eigen::Vector3d& point : cloud.points) {
    const std::uint32_t number =
        table_.insert({voxelCoordinate(point.x(), leaf_), voxelCoordinate(point.y(), leaf_),
                       voxelCoordinate(point.z(), leaf_)});
    if (number == voxels_.size()) {
      voxels_.push_back({point, 1});
      continue;
    }
    // A running mean keeps the digits that a sum of UTM coordinates would lose.
    Voxel& voxel = voxels_[number];
    ++voxel.count;
    voxel.mean += (point - voxel.mean) / static_cast<double>(voxel.count);
  }
}

DatasetCloud VoxelMap::cloud() const {
  DatasetCloud cloud;
  cloud.points.reserve(voxels_.size());
  for (const Voxel& voxel : voxels_) cloud.points.push_back(voxel.mean);
  return cloud;
}

}  // namespace pcrb
