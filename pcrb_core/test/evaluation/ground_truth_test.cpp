#include "pcrb_core/evaluation/ground_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

using Flags = std::vector<bool>;

TEST(FindOutliers, AreAboveTheMedianByMoreThanTheScoreTimesTheMad) {
  // Median 3, MAD 1: the limit is 3 + 3.5 / 0.6745 = 8.189.
  EXPECT_EQ(findOutliers({1, 2, 3, 4, 8.18}), Flags(5, false));
  EXPECT_EQ(findOutliers({8.2, 1, 2, 3, 4}), (Flags{true, false, false, false, false}));
}

TEST(FindOutliers, AreNeverBelowTheMedian) {
  EXPECT_EQ(findOutliers({-1000, 2, 3, 4, 5}), Flags(5, false));
}

TEST(FindOutliers, AreNoneWhereMostValuesAreTheSame) {
  EXPECT_EQ(findOutliers({2, 2, 2, 50}), Flags(4, false));
  EXPECT_TRUE(findOutliers({}).empty());
}

TEST(AssessGroundTruth, GivesMeanAndDeviationOfWhatIsNoOutlier) {
  const auto accuracy = assessGroundTruth({0.1, 0.2, 0.3, 0.4, 0.9});
  EXPECT_EQ(accuracy.outliers, 1U);
  EXPECT_EQ(accuracy.is_outlier, (Flags{false, false, false, false, true}));
  EXPECT_DOUBLE_EQ(accuracy.kept.mean, 0.25);
  EXPECT_DOUBLE_EQ(accuracy.kept.stddev, 0.5 * std::sqrt(0.05));
  EXPECT_EQ(accuracy.kept.count, 4U);
}

TEST(AssessGroundTruth, RefusesWhatIsNoLength) {
  EXPECT_THROW(assessGroundTruth({}), InvalidParameter);
  EXPECT_THROW(assessGroundTruth({0.1, -0.1}), InvalidParameter);
  EXPECT_THROW(assessGroundTruth({std::numeric_limits<double>::quiet_NaN()}), InvalidParameter);
  EXPECT_THROW(assessGroundTruth({std::numeric_limits<double>::infinity()}), InvalidParameter);
}

}  // namespace
}  // namespace pcrb
