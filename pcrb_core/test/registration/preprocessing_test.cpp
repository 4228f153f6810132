#include "pcrb_core/registration/preprocessing.hpp"

#include <gtest/gtest.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "support/scenes.hpp"

namespace pcrb {
namespace {

TEST(VoxelGrid, GivesThePointsOfPclsVoxelGrid) {
  const Points points = pcrb_test::hall(5).points;
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const auto& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(0.25F, 0.25F, 0.25F);
  pcl::PointCloud<pcl::PointXYZ> expected;
  grid.filter(expected);

  const Points found = voxelGrid(points, 0.25);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i] - expected[i].getVector3fMap()).norm(), 1e-5F) << i;
  }
}

TEST(VoxelGrid, DoesNotDependOnTheOrderOfCellsButKeepsTheirMeans) {
  const Points points{{0.1F, 0.1F, 0.1F}, {5.0F, 0.0F, 0.0F}, {0.3F, 0.3F, 0.1F}};
  const Points means = voxelGrid(points, 1.0);
  ASSERT_EQ(means.size(), 2U);
  EXPECT_TRUE(means[0].isApprox(Eigen::Vector3f(0.2F, 0.2F, 0.1F)));
  EXPECT_TRUE(means[1].isApprox(Eigen::Vector3f(5.0F, 0.0F, 0.0F)));
}

TEST(VoxelGrid, WorksWherePclsIndicesWouldOverflow) {
  EXPECT_EQ(voxelGrid({{-1500, -1500, -1500}, {1500, 1500, 1500}}, 0.01).size(), 2U);
}

TEST(VoxelGrid, RejectsALeafTooSmallForTheCloud) {
  EXPECT_THROW(voxelGrid({{-1500, 0, 0}, {1500, 0, 0}}, 1e-4), InvalidProblem);
}

TEST(Subsample, KeepsTheFractionInTheOrderOfThePoints) {
  Points points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
  const Points kept = subsample(points, 0.7, 1);
  EXPECT_EQ(kept.size(), 700U);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end(),
                             [](const auto& a, const auto& b) { return a.x() < b.x(); }));
  EXPECT_EQ(kept, subsample(points, 0.7, 1));
  EXPECT_NE(kept, subsample(points, 0.7, 2));
  EXPECT_EQ(subsample(points, 1.0, 1), points);
}

TEST(Subsample, KeepsEveryPointEquallyOften) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  std::array<int, 4> counts{};
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    for (const auto& point : subsample(points, 0.5, seed)) {
      ++counts[static_cast<std::size_t>(point.x())];
    }
  }
  for (const int count : counts) EXPECT_NEAR(count, 2000, 150);
}

}  // namespace
}  // namespace pcrb
