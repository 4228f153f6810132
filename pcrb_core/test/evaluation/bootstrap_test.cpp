#include "pcrb_core/evaluation/bootstrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "evaluation/series.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

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

}  // namespace
}  // namespace pcrb
