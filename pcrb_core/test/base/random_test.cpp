#include "pcrb_core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "pcrb_core/error.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {
namespace {

TEST(Random, IsTheStandardsMersenneTwister) {
  Random random(5489);  // the seed for which the standard fixes the 10000th value
  for (int i = 1; i < 10000; ++i) random.bits();
  EXPECT_EQ(random.bits(), 9981545732273789042u);
}

TEST(Random, BoundedIntegersAreUniform) {
  Random random(1);
  constexpr int kDraws = 60000;
  std::array<int, 6> counts{};
  for (int i = 0; i < kDraws; ++i) ++counts.at(random.below(6));
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 6, 5 * std::sqrt(kDraws / 6.0));
}

TEST(Random, BoundedIntegersAreUnbiasedForBoundsNearTheRange) {
  // Without rejection, 2^64 mod bound would make the lower half twice as frequent.
  constexpr std::uint64_t kBound = (std::uint64_t{1} << 63) + (std::uint64_t{1} << 62);
  Random random(2);
  constexpr int kDraws = 10000;
  int low = 0;
  for (int i = 0; i < kDraws; ++i) low += random.below(kBound) < kBound / 2 ? 1 : 0;
  EXPECT_NEAR(low, kDraws / 2, 5 * std::sqrt(kDraws / 4.0));
}

TEST(Random, UniformNumbersLieInTheirRangeAndFillIt) {
  Random random(3);
  double lowest = 1e9;
  double highest = -1e9;
  double sum = 0.0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform(-2.0, 6.0);
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
    sum += value;
  }
  EXPECT_GE(lowest, -2.0);
  EXPECT_LE(highest, 6.0);
  EXPECT_LT(lowest, -1.99);
  EXPECT_GT(highest, 5.99);
  EXPECT_NEAR(sum / kDraws, 2.0, 5 * 8.0 / std::sqrt(12.0 * kDraws));
  EXPECT_EQ(random.uniform(4.0, 4.0), 4.0);
}

TEST(Random, RefusesEmptyAndUnboundedRanges) {
  Random random(4);
  EXPECT_THROW(random.below(0), InvalidParameter);
  EXPECT_THROW(random.uniform(1.0, 0.0), InvalidParameter);
  EXPECT_THROW(random.uniform(0.0, std::numeric_limits<double>::infinity()), InvalidParameter);
}

TEST(Random, DirectionsAreUniformOnTheSphere) {
  Random random(5);
  constexpr int kDraws = 40000;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  std::array<int, 10> belts{};  // of equal height, hence of equal area
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d d = random.direction();
    ASSERT_NEAR(d.norm(), 1.0, 1e-15);
    mean += d / kDraws;
    second += d * d.transpose() / kDraws;
    ++belts.at(std::min<std::size_t>(9, static_cast<std::size_t>((d.z() + 1.0) * 5.0)));
  }
  EXPECT_LT(mean.norm(), 5.0 / std::sqrt(kDraws));
  EXPECT_LT((second - Eigen::Matrix3d::Identity() / 3.0).norm(), 5.0 / std::sqrt(kDraws));
  for (const int count : belts) EXPECT_NEAR(count, kDraws / 10, 5 * std::sqrt(kDraws / 10.0));
}

TEST(Random, RotationsHaveTheAnglesOfTheUniformDistribution) {
  Random random(6);
  constexpr int kDraws = 20000;
  std::array<int, 10> counts{};
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Quaterniond q = random.rotation();
    ASSERT_NEAR(q.norm(), 1.0, 1e-15);
    mean += q * Eigen::Vector3d(0.6, 0.0, 0.8) / kDraws;
    const double angle = rotationAngle(q.toRotationMatrix());
    // Distribution function of the angle under the Haar measure: (θ − sin θ) / π.
    const double rank = (angle - std::sin(angle)) / M_PI;
    ++counts.at(std::min<std::size_t>(9, static_cast<std::size_t>(rank * 10.0)));
  }
  EXPECT_LT(mean.norm(), 5.0 / std::sqrt(kDraws));
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 10, 5 * std::sqrt(kDraws / 10.0));
}

TEST(Random, ShuffleGivesEveryOrderEquallyOften) {
  Random random(7);
  constexpr int kDraws = 12000;
  std::array<int, 6> counts{};
  for (int i = 0; i < kDraws; ++i) {
    std::vector<int> order{0, 1, 2};
    random.shuffle(order);
    ++counts.at(static_cast<std::size_t>(2 * order[0] + (order[1] > order[2] ? 1 : 0)));
  }
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 6, 5 * std::sqrt(kDraws / 6.0));
}

TEST(Random, TheSameSeedGivesTheSameValues) {
  Random a(42);
  Random b(42);
  EXPECT_EQ(a.below(1000), b.below(1000));
  EXPECT_EQ(a.direction(), b.direction());
  EXPECT_EQ(a.rotation().coeffs(), b.rotation().coeffs());
  EXPECT_NE(Random(1).bits(), Random(2).bits());
}

}  // namespace
}  // namespace pcrb
