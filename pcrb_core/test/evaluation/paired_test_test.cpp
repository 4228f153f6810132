#include "pcrb_core/evaluation/paired_test.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evaluation/series.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

using pcrb_test::series;

std::vector<double> differences(std::size_t count, double shift) {
  auto result = series(count, 7919, 1009, 100);
  const auto other = series(count, 104729, 997, 100);
  for (std::size_t i = 0; i < count; ++i) result[i] = result[i] - other[i] + shift;
  return result;
}

void expectTest(const PairedTest& found, std::size_t count, double statistic, double p_value) {
  EXPECT_EQ(found.count, count);
  EXPECT_DOUBLE_EQ(found.statistic, statistic);
  EXPECT_NEAR(found.p_value / p_value, 1.0, 1e-9);
}

TEST(Wilcoxon, AgreesWithScipyWhereItIsExactAndWhereItIsApproximate) {  // scipy_values.py
  expectTest(wilcoxon(differences(10, 1.0)), 10, 1.0, 0.00390625);
  expectTest(wilcoxon(differences(40, 1.0)), 40, 258.0, 0.04080139504367253);
  expectTest(wilcoxon(differences(200, 0.5)), 200, 8272.5, 0.030093837947063204);
}

TEST(Wilcoxon, AgreesWithScipyWithTiesAndZeros) {  // scipy_values.py
  auto rounded = series(60, 7919, 101, 20);
  const auto other = series(60, 104729, 97, 20);
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    rounded[i] = std::nearbyint(rounded[i] - other[i]);
  }
  expectTest(wilcoxon(rounded), 48, 582.0, 0.9503609498295331);
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

}  // namespace
}  // namespace pcrb
