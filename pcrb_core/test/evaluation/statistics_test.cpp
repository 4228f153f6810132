#include "pcrb_core/evaluation/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "evaluation/series.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

TEST(Quantile, InterpolatesBetweenOrderStatisticsAtQTimesNMinusOne) {
  const std::vector<double> values{1.0, 2.0, 4.0, 8.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 3.0);
  EXPECT_EQ(quantile(values, 0.75), 5.0);         // position 2.25
  EXPECT_DOUBLE_EQ(quantile(values, 0.95), 7.4);  // position 2.85
  EXPECT_EQ(quantile(values, 1.0), 8.0);
  EXPECT_EQ(quantile({3.0}, 0.95), 3.0);
}

TEST(Quantile, RefusesNoValuesAndFractionsOutsideZeroToOne) {
  EXPECT_THROW(quantile({}, 0.5), InvalidParameter);
  EXPECT_THROW(quantile({1.0}, -0.1), InvalidParameter);
  EXPECT_THROW(quantile({1.0}, 1.1), InvalidParameter);
  EXPECT_THROW(quantile({1.0}, std::nan("")), InvalidParameter);
}

TEST(Statistics, HasTheHandComputedValues) {
  const Statistics statistics = describe({9.0, 2.0, 4.0, 4.0, 5.0, 4.0, 7.0, 5.0});
  EXPECT_EQ(statistics.count, 8u);
  EXPECT_EQ(statistics.median, 4.5);
  EXPECT_EQ(statistics.q75, 5.5);
  EXPECT_DOUBLE_EQ(statistics.q95, 8.3);
  EXPECT_EQ(statistics.mean, 5.0);
  EXPECT_EQ(statistics.stddev, 2.0);  // divided by n = 8, not by 7
}

TEST(Statistics, OfNothingAreNotNumbers) {
  const Statistics statistics = describe({});
  EXPECT_EQ(statistics.count, 0u);
  for (const double value :
       {statistics.median, statistics.q75, statistics.q95, statistics.mean, statistics.stddev}) {
    EXPECT_TRUE(std::isnan(value));
  }
}

TEST(Statistics, DoNotDependOnTheOrder) {
  Random random(1);
  std::vector<double> values;
  for (int i = 0; i < 1001; ++i) values.push_back(std::exp(random.uniform(-20.0, 5.0)));
  const Statistics first = describe(values);
  for (int i = 0; i < 5; ++i) {
    random.shuffle(values);
    const Statistics again = describe(values);
    EXPECT_EQ(again.mean, first.mean);
    EXPECT_EQ(again.stddev, first.stddev);
    EXPECT_EQ(again.q95, first.q95);
  }
}

TEST(Statistics, StayFiniteForTheLargestDoubles) {
  const Statistics statistics = describe({kLargest, kLargest, kLargest, 0.0});
  EXPECT_EQ(statistics.median, kLargest);
  EXPECT_DOUBLE_EQ(statistics.mean, kLargest / 4.0 * 3.0);
  EXPECT_DOUBLE_EQ(statistics.stddev, kLargest / 4.0 * std::sqrt(3.0));
  EXPECT_EQ(describe({kLargest, kLargest, kLargest}).mean, kLargest);
}

TEST(Statistics, OfEqualValuesHaveNoDeviation) {
  const Statistics statistics = describe(std::vector<double>(7, 0.1));
  EXPECT_EQ(statistics.mean, 0.1);
  EXPECT_LT(statistics.stddev, 1e-16);
  EXPECT_EQ(describe({0.0, 0.0}).stddev, 0.0);
}

TEST(Statistics, RefuseValuesThatAreNotFinite) {
  EXPECT_THROW(describe({1.0, std::nan("")}), InvalidParameter);
  EXPECT_THROW(describe({std::numeric_limits<double>::infinity()}), InvalidParameter);
}

using pcrb_test::series;

std::vector<std::size_t> ownUnits(std::size_t count) {
  std::vector<std::size_t> units(count);
  std::iota(units.begin(), units.end(), std::size_t{0});
  return units;
}

TEST(MedianInterval, AgreesWithScipy) {  // scipy_values.py, which draws 200,000 times
  BootstrapOptions options;
  options.resamples = 20000;
  const Interval interval = medianInterval(series(200, 7919, 1009, 100), ownUnits(200), options);
  EXPECT_NEAR(interval.low, 4.35, 0.05);
  EXPECT_NEAR(interval.high, 5.76, 0.05);
}

TEST(MedianInterval, DrawsWholeUnits) {
  // Thirty equal values of each of two units are no more evidence than one of each.
  std::vector<double> values;
  std::vector<std::size_t> units;
  for (std::size_t i = 0; i < 60; ++i) {
    units.push_back(i % 2);
    values.push_back(i % 2 == 0 ? 1.0 : 2.0);
  }
  const Interval interval = medianInterval(values, units);
  EXPECT_EQ(interval.low, 1.0);
  EXPECT_EQ(interval.high, 2.0);
}

TEST(MedianInterval, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const auto values = series(150, 7919, 1009, 100);
  const Interval first = medianInterval(values, ownUnits(150));
  const Interval again = medianInterval(values, ownUnits(150));
  EXPECT_EQ(first.low, again.low);
  EXPECT_EQ(first.high, again.high);
  BootstrapOptions other;
  other.resamples = 20;
  const Interval coarse = medianInterval(values, ownUnits(150), other);
  other.seed = 2;
  EXPECT_NE(coarse.low, medianInterval(values, ownUnits(150), other).low);
}

TEST(MedianInterval, DependsOnTheOrderOfUnitsOnlyNotOnThatOfTheirValues) {
  const Interval ascending = medianInterval({1.0, 2.0, 3.0, 4.0, 5.0}, {0, 0, 1, 1, 2});
  const Interval mixed = medianInterval({5.0, 4.0, 2.0, 1.0, 3.0}, {2, 1, 0, 0, 1});
  EXPECT_EQ(ascending.low, mixed.low);
  EXPECT_EQ(ascending.high, mixed.high);
}

TEST(MedianInterval, IsUnknownForOneUnit) {
  EXPECT_TRUE(std::isnan(medianInterval({1.0, 2.0, 3.0}, {0, 0, 0}).low));
  EXPECT_TRUE(std::isnan(medianInterval({}, {}).high));
}

TEST(MedianInterval, RefusesWhatItCannotDraw) {
  EXPECT_THROW(medianInterval({1.0, 2.0}, {0}), InvalidParameter);
  EXPECT_THROW(medianInterval({1.0, 2.0}, {0, 2}), InvalidParameter);
  EXPECT_THROW(medianInterval({1.0, 2.0, 3.0}, {0, 2, 2}), InvalidParameter);
  EXPECT_THROW(medianInterval({1.0, std::nan("")}, {0, 1}), InvalidParameter);
  EXPECT_THROW(medianInterval({1.0, 2.0}, {0, 1}, {0, 0.95, 1}), InvalidParameter);
  EXPECT_THROW(medianInterval({1.0, 2.0}, {0, 1}, {10, 1.0, 1}), InvalidParameter);
}

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
