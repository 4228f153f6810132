#include "registration/pcl_correspondences.hpp"

#include "registration/blocks.hpp"

namespace pcrb {

PclCloud::Ptr toPcl(const Points& points) {
  auto cloud = std::make_shared<PclCloud>();
  cloud->reserve(points.size());
  for (const auto& point : points) cloud->push_back({point.x(), point.y(), point.z()});
  return cloud;
}

void nearestCorrespondences(const KdTree& target, const PclCloud& source, int threads,
                            pcl::Correspondences& correspondences) {
  correspondences.resize(source.size());
  forBlocks(source.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Neighbor nearest = target.nearest(source[i].getVector3fMap());
      correspondences[i] = {static_cast<int>(i), static_cast<int>(nearest.index),
                            nearest.squared_distance};
    }
  });
}

}  // namespace pcrb
