#include "registration/pcl_common.hpp"

#include <type_traits>

#include "pcrb_core/parallel.hpp"
#include "pcrb_core/registration/registry.hpp"

namespace pcrb {

std::string pclOfMethods() {
  const bool is_double = std::is_same_v<PclScalar, double>;
  return std::string(PCL_VERSION_PRETTY) + (is_double ? ", double" : ", float");
}

PclCloud::Ptr toPcl(const Points& points) {
  PclCloud::Ptr cloud(new PclCloud);
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

IcpParameters::IcpParameters(ParameterReader& reader)
    : voxel_leaf(reader.positive("voxel_leaf", 0.2)),
      sampling_fraction(reader.number("sampling_fraction", 0.7, 1e-6, 1.0)),
      rejection_factor(reader.number("rejection_factor", 3.0, 1.0)),
      max_iterations(reader.integer("max_iterations", 35, 1)),
      translation_epsilon(reader.number("translation_epsilon", 0.01, 0.0)),
      seed(reader.seed("seed", 1)),
      threads(reader.threads()) {}

Points IcpParameters::filterTarget(const Points& points) const {
  return voxelGrid(points, voxel_leaf);
}

Points IcpParameters::filterSource(const Points& points) const {
  return subsample(voxelGrid(points, voxel_leaf), sampling_fraction, seed);
}

}  // namespace pcrb
