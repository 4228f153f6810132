#include "registration/features.hpp"

#include <gtest/gtest.h>
#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>

#include <numeric>

#include "pcrb_core/registration/registration.hpp"
#include "support/scenes.hpp"

namespace pcrb {
namespace {

using pcrb_test::hall;
using pcrb_test::transformed;

constexpr double kLeaf = 0.35;
constexpr double kNormalRadius = 2.0 * kLeaf;
constexpr double kFeatureRadius = 5.0 * kLeaf;

FpfhCloud describe(const PointCloud& cloud, int threads = 1) {
  return computeFpfh(KdTree(voxelGrid(cloud.points, kLeaf)), kNormalRadius, kFeatureRadius,
                     threads);
}

/// The same by PCL, with normals towards the centroid.
pcl::PointCloud<pcl::FPFHSignature33> describeWithPcl(const Points& points) {
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const auto& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  const pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> normal_estimation;
  normal_estimation.setInputCloud(cloud);
  normal_estimation.setRadiusSearch(kNormalRadius);
  const Eigen::Vector3f center = meanOf(points).cast<float>();
  normal_estimation.setViewPoint(center.x(), center.y(), center.z());
  normal_estimation.compute(*normals);
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33> estimation;
  estimation.setInputCloud(cloud);
  estimation.setInputNormals(normals);
  estimation.setRadiusSearch(kFeatureRadius);
  pcl::PointCloud<pcl::FPFHSignature33> features;
  estimation.compute(features);
  return features;
}

TEST(Fpfh, GivesPclsHistograms) {
  const Points points = voxelGrid(hall(1).points, kLeaf);
  const FpfhCloud found = describe(hall(1));
  const auto expected = describeWithPcl(points);
  ASSERT_EQ(found.features.size(), expected.size());
  double difference = 0.0;  // mean share of a histogram that lies in another bin, %
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (std::size_t bin = 0; bin < kFpfhSize; ++bin) {
      difference += std::abs(found.features[i][bin] - expected[i].histogram[bin]) / 6.0;
    }
  }
  EXPECT_LT(difference / static_cast<double>(expected.size()), 0.5);
}

TEST(Fpfh, SumsToOneHundredInEachOfItsThreeParts) {
  for (const auto& feature : describe(hall(1)).features) {
    for (std::size_t part = 0; part < kFpfhSize; part += kFpfhBins) {
      const auto begin = feature.begin() + static_cast<std::ptrdiff_t>(part);
      EXPECT_NEAR(std::accumulate(begin, begin + kFpfhBins, 0.0F), 100.0F, 1e-2F);
    }
  }
}

TEST(Fpfh, LeavesOutPointsWithoutANormal) {
  PointCloud cloud = hall(1);
  const std::size_t all = describe(cloud).points.size();
  cloud.points.emplace_back(40.0F, 0.0F, 0.0F);
  cloud.points.emplace_back(40.0F, 0.3F, 0.0F);
  EXPECT_EQ(describe(cloud).points.size(), all);
}

TEST(Fpfh, GivesTheSameBitsAtAnyThreadCount) {
  const FpfhCloud one = describe(hall(1), 1);
  const FpfhCloud three = describe(hall(1), 3);
  EXPECT_EQ(one.features, three.features);
}

FeatureParameters defaultParameters() {
  ParameterReader reader({});
  return FeatureParameters(reader);
}

TEST(FeatureMatcher, FindsManyTrueMatchesOfAMovedCloud) {
  Random random(2);
  const Transform P = pcrb_test::randomMotion(random, 2.0, 6.0);
  FeatureMatcher matcher(defaultParameters());
  matcher.setTarget(hall(1).points);
  const Matches matches = matcher.match(transformed(hall(2), P).points);
  std::size_t correct = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Eigen::Vector3d truth = P.inverse() * matches.source[i].cast<double>();
    if ((truth - matches.target[i].cast<double>()).norm() < 2.0 * kLeaf) ++correct;
  }
  EXPECT_GT(matches.size(), 100U);
  EXPECT_GT(5 * correct, matches.size());
}

TEST(FitRigid, IsExactForPointsThatWereMovedRigidly) {
  Random random(3);
  const Transform P = pcrb_test::randomMotion(random, 2.5, 10.0);
  Matches matches;
  for (int i = 0; i < 20; ++i) {
    matches.source.push_back((5.0 * random.direction()).cast<float>());
    matches.target.push_back((P * matches.source.back().cast<double>()).cast<float>());
  }
  matches.source.emplace_back(0.0F, 0.0F, 0.0F);
  matches.target.emplace_back(100.0F, 0.0F, 0.0F);
  std::vector<double> weights(20, 1.0);
  weights.push_back(0.0);
  EXPECT_LT((fitRigid(matches, weights).matrix() - P.matrix()).norm(), 1e-5);
}

}  // namespace
}  // namespace pcrb
