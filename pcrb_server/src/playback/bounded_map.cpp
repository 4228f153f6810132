#include "playback/bounded_map.hpp"

#include "pcrb_core/error.hpp"

namespace pcrb {

BoundedMap::BoundedMap(double leaf, std::size_t limit) : leaf_(leaf), limit_(limit), map_(leaf) {
  if (limit == 0) throw InvalidParameter("map: found a limit of 0 points, expected 1 or more");
}

void BoundedMap::add(const DatasetCloud& cloud) {
  map_.add(cloud);
  while (map_.size() > limit_) {
    leaf_ *= 2.0;
    VoxelMap coarser(leaf_);
    coarser.add(map_.cloud());
    map_ = std::move(coarser);
  }
}

}  // namespace pcrb
