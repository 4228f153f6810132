#include "pcrb_core/evaluation/correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evaluation/series.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

using pcrb_test::series;

void expectCorrelation(const Correlation& found, double rho, double p_value) {
  EXPECT_NEAR(found.rho, rho, 1e-12);
  EXPECT_NEAR(found.p_value / p_value, 1.0, 1e-9);
}

TEST(Ranks, OfEqualValuesAreTheMeanOfTheirPlaces) {
  EXPECT_EQ(ranks({3.0, 1.0, 3.0, 0.0, 3.0}), (std::vector<double>{4.0, 2.0, 4.0, 1.0, 4.0}));
  EXPECT_TRUE(ranks({}).empty());
}

TEST(Spearman, AgreesWithScipy) {  // scipy_values.py
  const auto x = series(200, 7919, 101, 10), y = series(200, 104729, 97, 8);
  expectCorrelation(spearman(x, y), 0.0655291469438955, 0.3565783015231224);
  auto mixed = x;
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] += 0.5 * y[i];
  expectCorrelation(spearman(x, mixed), 0.8731427445947567, 1.0568953950187236e-63);
  expectCorrelation(spearman({x.begin(), x.begin() + 6}, {y.begin(), y.begin() + 6}),
                    0.5428571428571429, 0.26570262390670557);
}

TEST(Spearman, IsOneForEveryRisingRelationAndMinusOneForEveryFallingOne) {
  const Correlation rising = spearman({1.0, 2.0, 3.0, 4.0}, {0.0, 1e-3, 1e3, 1e300});
  EXPECT_EQ(rising.rho, 1.0);
  EXPECT_EQ(rising.p_value, 0.0);
  EXPECT_EQ(spearman({1.0, 2.0, 3.0}, {0.0, -1.0, -7.0}).rho, -1.0);
}

TEST(Spearman, IsNotDefinedForAConstantOrForTooFewPairs) {
  EXPECT_TRUE(std::isnan(spearman({1.0, 1.0, 1.0}, {1.0, 2.0, 3.0}).rho));
  EXPECT_TRUE(std::isnan(spearman({1.0}, {1.0}).rho));
  EXPECT_TRUE(std::isnan(spearman({}, {}).rho));
  EXPECT_TRUE(std::isnan(spearman({1.0, 2.0}, {1.0, 2.0}).p_value));
}

TEST(Spearman, RefusesListsOfDifferentLengthsAndNaN) {
  EXPECT_THROW(spearman({1.0, 2.0}, {1.0}), InvalidParameter);
  EXPECT_THROW(spearman({1.0, std::nan("")}, {1.0, 2.0}), InvalidParameter);
}

}  // namespace
}  // namespace pcrb
