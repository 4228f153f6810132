#include "pcrb_core/search/voxel_map.hpp"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

DatasetCloud someCloud(std::uint64_t seed, const Eigen::Vector3d& corner, std::size_t n) {
  DatasetCloud cloud;
  Random random(seed);
  for (std::size_t i = 0; i < n; ++i) {
    cloud.points.emplace_back(corner.x() + random.uniform(0, 3), corner.y() + random.uniform(0, 3),
                              corner.z() + random.uniform(0, 1));
  }
  return cloud;
}

TEST(VoxelMap, HoldsTheCentroidOfEachVoxelOfAllClouds) {
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(-1.5, -1.5, -0.5), Eigen::Vector3d(702000, 8045000, 30)}) {
    VoxelMap map(0.2);
    std::map<std::tuple<int, int, int>, std::vector<Eigen::Vector3d>> expected;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const DatasetCloud cloud = someCloud(seed, corner, 2000);
      map.add(cloud);
      for (const auto& p : cloud.points) {
        const Eigen::Vector3i voxel = (p / 0.2).array().floor().cast<int>();
        expected[{voxel.x(), voxel.y(), voxel.z()}].push_back(p - corner);
      }
    }
    ASSERT_EQ(map.size(), expected.size());
    for (const auto& p : map.cloud().points) {
      const Eigen::Vector3i voxel = (p / 0.2).array().floor().cast<int>();
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      const auto& points = expected.at({voxel.x(), voxel.y(), voxel.z()});
      for (const auto& q : points) sum += q;
      EXPECT_LT((p - corner - sum / static_cast<double>(points.size())).norm(), 1e-8);
    }
  }
}

TEST(VoxelMap, DoesNotGrowWithCloudsThatAddNoVoxel) {
  VoxelMap map(0.5);
  const DatasetCloud cloud = someCloud(1, {0, 0, 0}, 5000);
  map.add(cloud);
  const std::size_t voxels = map.size();
  for (int i = 0; i < 10; ++i) map.add(cloud);
  EXPECT_EQ(map.size(), voxels);
}

TEST(VoxelMap, RefusesImpossibleLeavesAndCoordinates) {
  EXPECT_THROW(VoxelMap(0.0), InvalidParameter);
  EXPECT_THROW(VoxelMap(1.0 / 0.0), InvalidParameter);
  VoxelMap map(0.001);
  DatasetCloud cloud;
  cloud.points = {{0, 0, 2e6}};
  EXPECT_THROW(map.add(cloud), InvalidProblem);
}

}  // namespace
}  // namespace pcrb
