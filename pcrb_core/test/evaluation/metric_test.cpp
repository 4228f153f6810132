#include "pcrb_core/evaluation/metric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/scenes.hpp"

namespace pcrb {
namespace {

using pcrb_test::expectError;
using pcrb_test::randomMotion;

constexpr double kMax = std::numeric_limits<double>::max();
constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

PointCloud cloudOf(std::vector<Eigen::Vector3f> points) {
  PointCloud cloud;
  cloud.points = std::move(points);
  return cloud;
}

/// Centroid at the origin, distances from it 1, 1, 2, 2.
PointCloud cross() { return cloudOf({{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -2, 0}}); }

PointCloud randomCloud(Random& random, std::size_t count, double extent) {
  const Eigen::Vector3d center = random.direction() * random.uniform(0.0, 500.0);
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d offset = random.direction() * random.uniform(0.0, extent);
    cloud.points.push_back((center + offset).cast<float>());
  }
  return cloud;
}

Transform translation(double x, double y, double z) {
  return makeTransform({x, y, z}, Eigen::Quaterniond::Identity());
}

Transform rotation(double angle, const Eigen::Vector3d& axis) {
  return Transform(Eigen::AngleAxisd(angle, axis));
}

/// A motion of the kind and size of perturbations and residuals, about the frame's origin.
Transform someMotion(Random& random) {
  return randomMotion(random, random.uniform(0.0, 3.0), random.uniform(0.0, 20.0));
}

TEST(Metric, OfATranslationIsItsLengthTimesTheMeanInverseDistance) {
  const PoseError error = Metric(cross()).evaluate(translation(0, 3, 4));
  EXPECT_DOUBLE_EQ(error.error, 5.0 * (1.0 + 1.0 + 0.5 + 0.5) / 4.0);
  EXPECT_EQ(error.rotation_error, 0.0);
  EXPECT_DOUBLE_EQ(error.translation_error, 5.0);
}

TEST(Metric, OfARotationAboutTheCentroidIsTheChordOfTheUnitCircle) {
  const Metric metric(cross());
  for (const double angle : {1e-9, 0.3, 2.0, M_PI}) {  // all points lie across the axis
    const PoseError error = metric.evaluate(rotation(angle, Eigen::Vector3d::UnitZ()));
    EXPECT_NEAR(error.error, 2.0 * std::sin(angle / 2.0), 1e-15) << angle;
    EXPECT_NEAR(error.rotation_error, angle, 1e-15) << angle;
    EXPECT_EQ(error.translation_error, 0.0) << angle;
  }
}

TEST(Metric, OfPointsOnTheAxisOfRotationIsZero) {
  // Half a turn about x moves the points on y by twice their distance, those on x not at all.
  EXPECT_NEAR(Metric(cross()).evaluate(rotation(M_PI, Eigen::Vector3d::UnitX())).error, 1.0, 1e-15);
}

TEST(Metric, OfATurnWithATranslationIsTheMeanOverThePoints) {
  Transform T = rotation(M_PI, Eigen::Vector3d::UnitZ());
  T.translation() = Eigen::Vector3d(2, 0, 0);
  // (1,0)→(1,0), (−1,0)→(3,0), (0,2)→(2,−2), (0,−2)→(2,2).
  const double expected = (0.0 + 4.0 + std::sqrt(20.0) / 2.0 + std::sqrt(20.0) / 2.0) / 4.0;
  EXPECT_NEAR(Metric(cross()).evaluate(T).error, expected, 1e-15);
  EXPECT_NEAR(Metric(cross()).unnormalized(T), (4.0 + 2.0 * std::sqrt(20.0)) / 4.0, 1e-15);
}

TEST(Metric, OfTheIdentityIsExactlyZero) {
  Random random(1);
  const Metric metric(randomCloud(random, 1000, 30.0));
  const PoseError error = metric.evaluate(Transform::Identity());
  EXPECT_EQ(error.error, 0.0);
  EXPECT_EQ(error.rotation_error, 0.0);
  EXPECT_EQ(error.translation_error, 0.0);
  EXPECT_EQ(metric.unnormalized(Transform::Identity()), 0.0);
}

TEST(Metric, IsPositiveForAnyOtherTransform) {
  Random random(2);
  const Metric metric(randomCloud(random, 1000, 30.0));
  for (int i = 0; i < 20; ++i) {
    EXPECT_GT(metric.evaluate(randomMotion(random, 1e-6, 0.0)).error, 1e-8);
    EXPECT_GT(metric.evaluate(randomMotion(random, 0.0, 1e-6)).error, 1e-9);
  }
}

// An isometry keeps distances: ‖T⁻¹g − g‖ = ‖T⁻¹g − T⁻¹Tg‖ = ‖g − Tg‖ for every point.
TEST(Metric, IsTheSameForATransformAndItsInverse) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Metric metric(randomCloud(random, 500, 30.0));
    const Transform T = someMotion(random);
    const PoseError forth = metric.evaluate(T);
    const PoseError back = metric.evaluate(T.inverse());
    EXPECT_NEAR(forth.error, back.error, 1e-11 * forth.error);
    EXPECT_NEAR(forth.translation_error, back.translation_error, 1e-11 * forth.translation_error);
    EXPECT_NEAR(metric.unnormalized(T), metric.unnormalized(T.inverse()),
                1e-11 * metric.unnormalized(T));
  }
}

// ‖ABg − g‖ ≤ ‖ABg − Ag‖ + ‖Ag − g‖ = ‖Bg − g‖ + ‖Ag − g‖ for every point.
TEST(Metric, SatisfiesTheTriangleInequality) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Metric metric(randomCloud(random, 50, 30.0));
    const Transform A = someMotion(random);
    const Transform B = someMotion(random);
    const double sum = metric.evaluate(A).error + metric.evaluate(B).error;
    EXPECT_LE(metric.evaluate(A * B).error, sum * (1.0 + 1e-12));
    EXPECT_GE(metric.evaluate(A * B).error,
              std::abs(metric.evaluate(A).error - metric.evaluate(B).error) * (1.0 - 1e-12));
  }
}

TEST(Metric, DoesNotDependOnTheUnitOfLength) {
  Random random(5);
  const PointCloud cloud = randomCloud(random, 500, 30.0);
  PointCloud larger = cloud;
  for (Eigen::Vector3f& point : larger.points) point *= 4.0F;
  const Transform T = someMotion(random);
  Transform scaled = T;
  scaled.translation() *= 4.0;
  EXPECT_DOUBLE_EQ(Metric(larger).evaluate(scaled).error, Metric(cloud).evaluate(T).error);
}

TEST(Metric, DoesNotDependOnTheFrame) {
  Random random(6);
  // Whole coordinates and a quarter turn: the other frame's points are exact.
  Transform T_other_this = Transform::Identity();
  T_other_this.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  T_other_this.translation() = Eigen::Vector3d(512, -256, 64);
  PointCloud cloud = randomCloud(random, 500, 100.0);
  PointCloud other = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.points[i] = cloud.points[i].array().round();
    other.points[i] = (T_other_this * cloud.points[i].cast<double>()).cast<float>();
  }
  const Transform T = someMotion(random);
  const PoseError here = Metric(cloud).evaluate(T);
  const PoseError there = Metric(other).evaluate(T_other_this * T * T_other_this.inverse());
  EXPECT_NEAR(there.error, here.error, 1e-12);
  EXPECT_NEAR(there.rotation_error, here.rotation_error, 1e-12);
  EXPECT_NEAR(there.translation_error, here.translation_error, 1e-10);
}

TEST(Metric, ReportsTheTranslationOfTheCentroidNotOfTheFramesOrigin) {
  PointCloud cloud = cross();
  for (Eigen::Vector3f& point : cloud.points) point += Eigen::Vector3f(1024, 0, 0);
  const Eigen::Vector3d c(1024, 0, 0);
  const Transform T =
      Eigen::Translation3d(c) * rotation(0.1, Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-c);
  const PoseError error = Metric(cloud).evaluate(T);
  EXPECT_GT(T.translation().norm(), 100.0);
  EXPECT_LT(error.translation_error, 1e-12);
  EXPECT_NEAR(error.rotation_error, 0.1, 1e-14);
}

TEST(Metric, LeavesPointsAtTheCentroidOutOfSumAndCount) {
  PointCloud cloud = cross();
  cloud.points.insert(cloud.points.begin() + 1, {0, 0, 0});
  cloud.points.push_back({0, 0, 0});
  const Metric metric(cloud);
  EXPECT_EQ(metric.weighted(), 4u);
  EXPECT_EQ(metric.weightless(), 2u);
  EXPECT_DOUBLE_EQ(metric.evaluate(translation(0, 3, 4)).error, 3.75);
  EXPECT_DOUBLE_EQ(metric.unnormalized(translation(0, 3, 4)), 5.0);  // over all six
}

TEST(Metric, TakesANanometreForTheRadiusWithoutWeight) {
  const auto weightless = [](float distance) {
    return Metric(cloudOf({{distance, 0, 0}, {-distance, 0, 0}, {1, 0, 0}, {-1, 0, 0}}))
        .weightless();
  };
  EXPECT_EQ(weightless(0.999e-9F), 2u);
  EXPECT_EQ(weightless(1.001e-9F), 0u);
}

TEST(Metric, RefusesCloudsWithoutAPointThatCarriesWeight) {
  expectError<InvalidProblem>([] { Metric{PointCloud{}}; }, "no points");
  expectError<InvalidProblem>([] { Metric(cloudOf({{1, 2, 3}})); }, "1 points", "centroid");
  expectError<InvalidProblem>(
      [] {
        Metric(cloudOf({{0.1F, 2, 3}, {0.1F, 2, 3}, {0.1F, 2, 3}}));
      },
      "3 points", "centroid");
}

TEST(Metric, RefusesCloudsThatAreNotFinite) {
  for (const float bad : {kNoNumber, std::numeric_limits<float>::infinity()}) {
    expectError<InvalidProblem>(
        [&] {
          Metric(cloudOf({{0, 0, 0}, {0, bad, 0}, {1, 0, 0}}));
        },
        "not finite");
  }
}

TEST(Metric, RefusesTransformsThatAreNotFiniteOrNotRigid) {
  const Metric metric(cross());
  Transform T = Transform::Identity();
  T.translation().y() = kNoNumber;
  expectError<InvalidProblem>([&] { metric.evaluate(T); }, "not finite");
  expectError<InvalidProblem>([&] { metric.unnormalized(T); }, "not finite");
  T = Transform::Identity();
  T.linear() *= 1.01;
  expectError<InvalidProblem>([&] { metric.evaluate(T); }, "not rigid");
}

TEST(Metric, StaysFiniteForTheLargestTranslations) {
  const Metric metric(cross());
  PoseError error = metric.evaluate(translation(1e300, 0, 0));
  EXPECT_DOUBLE_EQ(error.error, 0.75 * 1e300);
  EXPECT_DOUBLE_EQ(error.translation_error, 1e300);
  EXPECT_DOUBLE_EQ(metric.unnormalized(translation(0, -1e200, 0)), 1e200);
  error = metric.evaluate(translation(kMax, -kMax, kMax));
  EXPECT_EQ(error.error, kMax);
  EXPECT_EQ(error.translation_error, kMax);
  EXPECT_EQ(metric.unnormalized(translation(kMax, kMax, kMax)), kMax);
}

TEST(Metric, StaysFiniteForTheLargestCoordinatesAndWeights) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  const Metric metric(cloudOf({{kLargest, kLargest, kLargest},
                               {-kLargest, -kLargest, -kLargest},
                               {2e-9F, 0, 0},
                               {-2e-9F, 0, 0}}));
  EXPECT_EQ(metric.weighted(), 4u);
  Transform turned = rotation(3.0, Eigen::Vector3d::UnitX());
  EXPECT_TRUE(std::isfinite(metric.evaluate(turned).error));
  EXPECT_TRUE(std::isfinite(metric.unnormalized(turned)));
  turned.translation() = Eigen::Vector3d::Constant(kMax);
  EXPECT_EQ(metric.evaluate(turned).error, kMax);
}

TEST(Metric, GivesTheSameBitsAgain) {
  Random random(7);
  const PointCloud cloud = randomCloud(random, 1003, 30.0);
  const Transform T = someMotion(random);
  EXPECT_EQ(Metric(cloud).evaluate(T).error, Metric(cloud).evaluate(T).error);
}

}  // namespace
}  // namespace pcrb
