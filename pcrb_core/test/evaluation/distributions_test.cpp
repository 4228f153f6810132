#include "pcrb_core/evaluation/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/metric.hpp"

namespace pcrb {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Histogram, CountsEveryValueOnceBinsHalfOpenTheLastOneClosed) {
  const Histogram histogram =
      makeHistogram({-0.1, 0.0, 0.49, 0.5, 1.0, 1.99, 2.0, 2.01, 1e300}, 0.0, 2.0, 4);
  EXPECT_EQ(histogram.counts, (std::vector<std::size_t>{2, 1, 1, 2}));
  EXPECT_EQ(histogram.below, 1u);
  EXPECT_EQ(histogram.above, 2u);
  EXPECT_EQ(histogram.width(), 0.5);
}

TEST(Histogram, RefusesBinsOfNoWidthAndNaN) {
  EXPECT_THROW(makeHistogram({}, 1.0, 1.0, 4), InvalidParameter);
  EXPECT_THROW(makeHistogram({}, 0.0, 1.0, 0), InvalidParameter);
  EXPECT_THROW(makeHistogram({kNaN}, 0.0, 1.0, 4), InvalidParameter);
}

TEST(BinnedQuantiles, HoldEquallyManyValuesInAscendingBins) {
  const auto bins = binnedQuantiles({4.0, 3.0, 2.0, 1.0}, {40.0, 30.0, 20.0, 10.0}, 2);
  ASSERT_EQ(bins.size(), 2u);
  EXPECT_EQ(bins[0].low, 1.0);
  EXPECT_EQ(bins[0].high, 3.0);
  EXPECT_EQ(bins[0].median, 15.0);
  EXPECT_EQ(bins[0].q25, 12.5);
  EXPECT_EQ(bins[1].high, 4.0);
  EXPECT_EQ(bins[1].count, 2u);
  EXPECT_EQ(bins[1].q75, 37.5);
}

TEST(BinnedQuantiles, KeepEqualValuesTogetherAndHaveNoEmptyBin) {
  const auto bins = binnedQuantiles({1.0, 1.0, 1.0, 1.0, 2.0}, {1.0, 2.0, 3.0, 4.0, 5.0}, 4);
  ASSERT_EQ(bins.size(), 2u);
  EXPECT_EQ(bins[0].count, 4u);
  EXPECT_EQ(bins[1].count, 1u);
  EXPECT_TRUE(binnedQuantiles({}, {}, 4).empty());
  EXPECT_THROW(binnedQuantiles({1.0}, {}, 4), InvalidParameter);
  EXPECT_THROW(binnedQuantiles({kNaN}, {1.0}, 4), InvalidParameter);
}

TEST(FractionSolved, CountsAnsweredProblemsOutOfAll) {
  const std::vector<ProblemOutcome> attempts{{true, 0.1, 0.0, 0.0},
                                             {true, 0.3, 0.0, 0.0},
                                             {false, 0.05, 0.0, 0.0},  // unanswered: not solved
                                             {true, 2.0, 0.0, 0.0}};
  EXPECT_EQ(fractionSolved(attempts, {0.01, 0.1, 0.5, 5.0}),
            (std::vector<double>{0.0, 0.25, 0.5, 0.75}));
  EXPECT_TRUE(std::isnan(fractionSolved({}, {1.0})[0]));
  EXPECT_THROW(fractionSolved(attempts, {1.0, 0.5}), InvalidParameter);
}

TEST(RegistrationRecall, NeedsBothErrorsWithinTheirLimits) {
  const std::vector<ProblemOutcome> attempts{{true, 0.1, 0.01, 0.1},
                                             {true, 0.1, 0.01, 0.5},
                                             {true, 0.1, 0.20, 0.1},
                                             {false, 0.1, 0.0, 0.0}};
  EXPECT_EQ(registrationRecall(attempts, 0.1, 0.01), 0.25);
  EXPECT_EQ(registrationRecall(attempts, 0.5, 0.01), 0.5);
  EXPECT_EQ(registrationRecall(attempts, 1.0, 1.0), 0.75);
  EXPECT_TRUE(std::isnan(registrationRecall({{true, 0.1, kNaN, 0.1}}, 1.0, 1.0)));
  EXPECT_TRUE(std::isnan(registrationRecall({}, 1.0, 1.0)));
}

TEST(LogarithmicSteps, RiseByEqualRatiosBetweenTheirEnds) {
  const auto steps = logarithmicSteps(0.01, 100.0, 5);
  ASSERT_EQ(steps.size(), 5u);
  EXPECT_EQ(steps.front(), 0.01);
  EXPECT_EQ(steps.back(), 100.0);
  EXPECT_NEAR(steps[2], 1.0, 1e-12);
  EXPECT_THROW(logarithmicSteps(0.0, 1.0, 3), InvalidParameter);
}

TEST(PoseComponents, AreTheAnglesThatTheRotationWasMadeOfAndTheCentroidsMotion) {
  const double roll = 0.3, pitch = -0.7, yaw = 2.1;
  Transform T = Transform::Identity();
  T.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  const Eigen::Vector3d centroid(100.0, -50.0, 3.0), motion(0.1, 0.2, -0.3);
  T.translation() = centroid + motion - T.linear() * centroid;
  const PoseComponents components = poseComponents(T, centroid);
  EXPECT_NEAR(components.roll, roll, 1e-14);
  EXPECT_NEAR(components.pitch, pitch, 1e-14);
  EXPECT_NEAR(components.yaw, yaw, 1e-14);
  EXPECT_LT((components.translation - motion).norm(), 1e-12);
}

TEST(PoseComponents, HaveNoRollWherePitchIsARightAngle) {
  Transform T = Transform::Identity();
  T.linear() = (Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitY()))
                   .toRotationMatrix();
  const PoseComponents components = poseComponents(T, Eigen::Vector3d::Zero());
  EXPECT_EQ(components.roll, 0.0);
  EXPECT_NEAR(components.pitch, std::acos(0.0), 1e-8);
}

}  // namespace
}  // namespace pcrb
