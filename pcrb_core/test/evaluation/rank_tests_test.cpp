#include "pcrb_core/evaluation/rank_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

std::vector<double> differences(std::size_t count, double shift) {
  auto result = series(count, 7919, 1009, 100);
  const auto other = series(count, 104729, 997, 100);
  for (std::size_t i = 0; i < count; ++i) result[i] = result[i] - other[i] + shift;
  return result;
}

void expectTest(const PairedTest& found, std::size_t count, double statistic, double p_value) {
  EXPECT_EQ(found.count, count);
  EXPECT_DOUBLE_EQ(std::min(found.positive, found.negative), statistic);
  EXPECT_NEAR(found.p_value / p_value, 1.0, 1e-9);
}

TEST(Wilcoxon, AgreesWithScipyWhereItIsExactAndWhereItIsApproximate) {  // scipy_values.py
  expectTest(wilcoxon(differences(10, 1.0)), 10, 1.0, 0.00390625);
  expectTest(wilcoxon(differences(40, 1.0)), 40, 258.0, 0.04080139504367253);
  expectTest(wilcoxon(differences(200, 0.5)), 200, 8272.5, 0.030093837947063204);
}

TEST(Wilcoxon, AgreesWithScipyWithTiesAndZeros) {  // scipy_values.py
  auto rounded = series(90, 7919, 101, 20);
  const auto other = series(90, 104729, 97, 20);
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    rounded[i] = std::nearbyint(rounded[i] - other[i]);
  }
  expectTest(wilcoxon(rounded), 73, 1342.5, 0.964518246502488);
}

/// Fraction of all choices of signs whose smaller rank sum is at most the one found, with the ranks
/// of equal magnitudes made equal: the definition of the exact p-value.
double pOfAllSigns(const std::vector<double>& differences) {
  std::vector<double> magnitudes;
  for (const double difference : differences) {
    if (difference != 0.0) magnitudes.push_back(std::abs(difference));
  }
  const std::vector<double> rank = ranks(magnitudes);
  const PairedTest found = wilcoxon(differences);
  std::size_t extreme = 0;
  for (std::size_t signs = 0; signs < std::size_t{1} << rank.size(); ++signs) {
    double positive = 0.0, negative = 0.0;
    for (std::size_t i = 0; i < rank.size(); ++i)
      ((signs >> i & 1) ? positive : negative) += rank[i];
    if (std::min(positive, negative) <= std::min(found.positive, found.negative)) ++extreme;
  }
  return std::ldexp(static_cast<double>(extreme), -static_cast<int>(rank.size()));
}

TEST(Wilcoxon, IsExactForFewDifferencesWithZerosAndTies) {
  EXPECT_EQ(wilcoxon({0.0, 1.0, 2.0, 3.0, 4.0, 5.0}).p_value, 0.0625);  // 2 of 2^5: scipy's too
  for (const std::vector<double>& few : {std::vector<double>{0.0, 1.0, 2.0, -3.0, 4.0, 5.0},
                                         {1.0, 1.0, 1.0, 1.0, 1.0},
                                         {2.0, -1.0, 2.0, 2.0, -1.0, 3.0, 0.0},
                                         {-1.0, 1.0},
                                         {0.0, -1.0, 1.0, 1.0, 4.0, 4.0, 9.0}}) {
    EXPECT_EQ(wilcoxon(few).p_value, pOfAllSigns(few));
  }
  // scipy_values.py, permutation_test
  const std::vector<double> few{1, 3, 2, 1, -1, 3, 2, 4, -3, 1, -2, 2};
  expectTest(wilcoxon(few), 12, 19.0, 0.1298828125);
}

TEST(Wilcoxon, SaysTheDirectionOfItsRankSumsWhereTheMedianDifferenceSaysTheOther) {
  std::vector<double> mixed(55, -0.01);
  for (std::size_t i = 0; i < 45; ++i) mixed.push_back(1.0 + static_cast<double>(i) / 45.0);
  const PairedTest test = wilcoxon(mixed);
  EXPECT_EQ(test.negative, 55.0 * 56.0 / 2.0);
  EXPECT_EQ(test.positive, 100.0 * 101.0 / 2.0 - test.negative);
  EXPECT_LT(test.p_value, 0.001);
  EXPECT_GT(test.pseudomedian, 0.0);  // the median of `mixed` is -0.01
}

TEST(Wilcoxon, HasThePseudomedianOfAllAverages) {
  EXPECT_EQ(wilcoxon({3.0}).pseudomedian, 3.0);
  EXPECT_EQ(wilcoxon({1.0, 4.0}).pseudomedian, 2.5);
  EXPECT_EQ(wilcoxon({0.0, -1.0, 2.0, 5.0}).pseudomedian, 2.0);  // of -1, 0.5, 2, 2, 3.5, 5
  EXPECT_EQ(wilcoxon({-2.0, 2.0}).pseudomedian, 0.0);
  // scipy_values.py
  EXPECT_NEAR(wilcoxon(differences(10, 1.0)).pseudomedian, 4.195, 1e-12);
  EXPECT_NEAR(wilcoxon(differences(40, 1.0)).pseudomedian, 1.36, 1e-12);
  EXPECT_NEAR(wilcoxon(differences(200, 0.5)).pseudomedian, 0.695, 1e-12);
}

TEST(Wilcoxon, HasTheHandComputedValueForThreeDifferencesOfOneSign) {
  EXPECT_EQ(wilcoxon({1.0, 2.0, 3.0}).p_value, 0.25);  // two of the 2^3 signs are as extreme
}

TEST(Wilcoxon, FindsNoDifferenceWhereThereIsNone) {
  EXPECT_EQ(wilcoxon({}).p_value, 1.0);
  EXPECT_EQ(wilcoxon({0.0, 0.0}).p_value, 1.0);
  EXPECT_EQ(wilcoxon({0.0, 0.0}).count, 0u);
}

TEST(Wilcoxon, RefusesDifferencesThatAreNotFinite) {
  EXPECT_THROW(wilcoxon({1.0, std::nan("")}), InvalidParameter);
}

TEST(Holm, MultipliesByTheNumberOfTestsThatAreLeftAndNeverFalls) {
  const auto adjusted = holmAdjusted({0.04, 0.01, 0.03, 0.8});
  EXPECT_DOUBLE_EQ(adjusted[1], 0.04);  // 4 · 0.01
  EXPECT_DOUBLE_EQ(adjusted[2], 0.09);  // 3 · 0.03
  EXPECT_DOUBLE_EQ(adjusted[0], 0.09);  // 2 · 0.04 = 0.08 would fall below the one before
  EXPECT_DOUBLE_EQ(adjusted[3], 0.8);
  EXPECT_EQ(holmAdjusted({0.5, 0.6}), (std::vector<double>{1.0, 1.0}));
  EXPECT_TRUE(holmAdjusted({}).empty());
}

TEST(Holm, RefusesWhatIsNoProbability) {
  EXPECT_THROW(holmAdjusted({1.5}), InvalidParameter);
  EXPECT_THROW(holmAdjusted({std::nan("")}), InvalidParameter);
}

TEST(OrderTest, CountsTheOrdersInWhichFirstsAreAsLargeOrLarger) {
  const OrderTest all = firstAgainstLater({{9, 1, 2, 3}, {5, 4, 3, 2}, {7, 6}});
  EXPECT_EQ(all.groups, 3u);
  EXPECT_DOUBLE_EQ(all.p_value, 1.0 / (4 * 4 * 2));
  EXPECT_DOUBLE_EQ(all.smallest_p, all.p_value);
  EXPECT_DOUBLE_EQ(firstAgainstLater({{2, 1, 3}}).p_value, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(firstAgainstLater({{1, 2, 3}, {3, 2, 1}}).p_value, 6.0 / 9.0);
}

TEST(OrderTest, SharesTheRanksOfEqualValuesAndLeavesOutSingleOnes) {
  const OrderTest equal = firstAgainstLater({{1, 1, 1}, {4}, {}});
  EXPECT_EQ(equal.groups, 1u);
  EXPECT_DOUBLE_EQ(equal.p_value, 1.0);
  EXPECT_DOUBLE_EQ(firstAgainstLater({{1, 1, 0}}).p_value, 2.0 / 3.0);  // either of the ones
  EXPECT_DOUBLE_EQ(firstAgainstLater({}).p_value, 1.0);
}

}  // namespace
}  // namespace pcrb
