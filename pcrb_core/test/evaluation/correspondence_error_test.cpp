#include "pcrb_core/evaluation/correspondence_error.hpp"

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/metric.hpp"
#include "support/expect_error.hpp"
#include "support/scenes.hpp"

namespace pcrb {
namespace {

using Cloud = std::vector<Eigen::Vector3d>;

TEST(CorrespondenceError, IsTheMeanOfDistanceByDistanceFromTheAlignedCentroid) {
  const Cloud aligned{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, -3, 0}};  // centroid (2, 0, 0)
  const Cloud truth{{0, 0, 1}, {4, 0, 0}, {2, 3, 6}, {2, 0, 0}};
  EXPECT_DOUBLE_EQ(error(aligned, truth), (1.0 / 2 + 0.0 + 6.0 / 3 + 3.0 / 3) / 4);
  EXPECT_EQ(error(aligned, aligned), 0.0);
}

TEST(CorrespondenceError, IsTheMetricOfARigidTransform) {
  Random random(3);
  PointCloud truth = pcrb_test::hall(1);
  truth.local_origin = {702000.0, 8045000.0, 100.0};
  const Transform T = pcrb_test::randomMotion(random, 0.3, 1.0);
  const PointCloud aligned = pcrb_test::transformed(truth, T);
  EXPECT_NEAR(error(aligned, truth), Metric(truth).evaluate(T).error, 1e-6);
}

TEST(CorrespondenceError, LeavesOutAPointAtTheCentroid) {
  const Cloud aligned{{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  const Cloud truth{{-1, 1, 0}, {1, 1, 0}, {0, 50, 0}};
  EXPECT_DOUBLE_EQ(error(aligned, truth), 1.0);
}

TEST(CorrespondenceError, RefusesCloudsThatAreNotHomologous) {
  const Cloud two{{0, 0, 0}, {1, 0, 0}};
  PCRB_EXPECT_ERROR(InvalidProblem, error(two, {{0, 0, 0}}), "found 2 aligned points and 1");
  PCRB_EXPECT_ERROR(InvalidProblem, error({{0, 0, 0}, {0, std::nan(""), 0}}, two), "point 1");
  PCRB_EXPECT_ERROR(InvalidProblem, error(two, {{INFINITY, 0, 0}, {0, 0, 0}}), "point 0");
  PCRB_EXPECT_ERROR(InvalidProblem, error(Cloud{}, Cloud{}), "no point farther");
  PCRB_EXPECT_ERROR(InvalidProblem, error({{1, 1, 1}}, {{0, 0, 0}}), "no point farther");
}

/// PCL 1.10 has no constructor for it.
pcl::PointXYZI pclPoint(float x, float y, float z) {
  pcl::PointXYZI point;
  point.x = x;
  point.y = y;
  point.z = z;
  point.intensity = 9.0F;
  return point;
}

TEST(CorrespondenceErrorOfPclClouds, IsThatOfTheSamePoints) {
  pcl::PointCloud<pcl::PointXYZI> aligned, truth;
  Cloud p, g;
  for (int i = 0; i < 20; ++i) {
    const auto k = static_cast<float>(i);
    aligned.push_back(pclPoint(k, k * k, 1.0F));
    truth.push_back(pclPoint(k + 0.5F, k * k, 1.0F));
    p.emplace_back(k, k * k, 1.0);
    g.emplace_back(k + 0.5, k * k, 1.0);
  }
  EXPECT_EQ(error(aligned, truth), error(p, g));
}

}  // namespace
}  // namespace pcrb
