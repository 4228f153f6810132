#include "pcrb_core/evaluation/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

constexpr double kMax = std::numeric_limits<double>::max();

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
  const Statistics statistics = describe({kMax, kMax, kMax, 0.0});
  EXPECT_EQ(statistics.median, kMax);
  EXPECT_DOUBLE_EQ(statistics.mean, kMax / 4.0 * 3.0);
  EXPECT_DOUBLE_EQ(statistics.stddev, kMax / 4.0 * std::sqrt(3.0));
  EXPECT_EQ(describe({kMax, kMax, kMax}).mean, kMax);
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

}  // namespace
}  // namespace pcrb
