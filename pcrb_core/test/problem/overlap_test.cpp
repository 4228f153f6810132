#include "pcrb_core/problem/overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/random.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

DatasetCloud someCloud(std::uint64_t seed, double shift, std::size_t n = 400) {
  DatasetCloud cloud;
  Random random(seed);
  for (std::size_t i = 0; i < n; ++i) {
    cloud.points.emplace_back(shift + random.uniform(0, 4), random.uniform(0, 4), random.uniform());
  }
  return cloud;
}

double overlapByForce(const DatasetCloud& source, const DatasetCloud& target, double distance) {
  std::size_t count = 0;
  for (const auto& p : source.points) {
    for (const auto& q : target.points) {
      if ((p - q).norm() < distance) {
        ++count;
        break;
      }
    }
  }
  return static_cast<double>(count) / static_cast<double>(source.points.size());
}

/// Nine clouds along a line, written as PCD files.
class OverlapSequence : public ::testing::Test {
 protected:
  OverlapSequence() {
    for (std::size_t i = 0; i < kClouds; ++i) {
      clouds_.push_back(someCloud(i, 0.7 * static_cast<double>(i)));
      job_.files.push_back(folder_.file("cloud" + std::to_string(i) + ".pcd"));
      writePcd(job_.files.back(), clouds_.back());
      job_.targets.push_back(i);
    }
    job_.distance = 0.2;
    job_.threads = 2;
    events_.cloud_read = [this](std::size_t cloud) { ++reads_[cloud]; };
    events_.column_done = [this](std::size_t target, const std::vector<double>& column) {
      EXPECT_TRUE(columns_.emplace(target, column).second) << "target " << target << " twice";
    };
  }

  static constexpr std::size_t kClouds = 9;
  pcrb_test::TemporaryFolder folder_;
  std::vector<DatasetCloud> clouds_;
  OverlapJob job_;
  OverlapEvents events_;
  std::map<std::size_t, int> reads_;
  std::map<std::size_t, std::vector<double>> columns_;
};

TEST_F(OverlapSequence, IsTheShareOfSourcePointsNearTheTargetForAllOrderedPairs) {
  EXPECT_EQ(countPairs(job_), kClouds * (kClouds - 1));
  computeOverlaps(job_, events_);
  ASSERT_EQ(columns_.size(), kClouds);
  for (std::size_t target = 0; target < kClouds; ++target) {
    for (std::size_t source = 0; source < kClouds; ++source) {
      EXPECT_EQ(columns_[target][source],
                overlapByForce(clouds_[source], clouds_[target], job_.distance))
          << source << " on " << target;
    }
  }
  EXPECT_NE(columns_[0][1], columns_[1][0]);
}

TEST_F(OverlapSequence, ReadsEachCloudOnceWithAndWithoutAWindow) {
  for (const std::size_t window : {0U, 1U, 3U, 100U}) {
    reads_.clear();
    columns_.clear();
    job_.window = window;
    computeOverlaps(job_, events_);
    ASSERT_EQ(reads_.size(), kClouds) << window;
    for (const auto& [cloud, count] : reads_) EXPECT_EQ(count, 1) << cloud;
  }
}

TEST_F(OverlapSequence, WindowLeavesFartherPairsUnknown) {
  job_.window = 2;
  computeOverlaps(job_, events_);
  std::size_t pairs = 0;
  for (const auto& [target, column] : columns_) {
    for (std::size_t source = 0; source < kClouds; ++source) {
      const std::size_t apart = source > target ? source - target : target - source;
      EXPECT_EQ(std::isnan(column[source]), apart > 2);
      pairs += apart > 0 && apart <= 2 ? 1 : 0;
    }
  }
  EXPECT_EQ(countPairs(job_), pairs);
}

TEST_F(OverlapSequence, ComputesOnlyTheWantedTargets) {
  job_.targets = {2, 7};
  computeOverlaps(job_, events_);
  ASSERT_EQ(columns_.size(), 2U);
  EXPECT_EQ(columns_[7][5], overlapByForce(clouds_[5], clouds_[7], job_.distance));
  job_.targets = {9};
  EXPECT_THROW(computeOverlaps(job_, events_), InvalidParameter);
}

TEST_F(OverlapSequence, NamesTheCloudThatIsMissingEmptyOrInAnotherFrame) {
  const auto error = [&] {
    try {
      computeOverlaps(job_, events_);
    } catch (const Error& caught) {
      return std::string(caught.what());
    }
    return std::string("no error");
  };
  job_.files[3] = folder_.file("absent.pcd");
  EXPECT_NE(error().find("absent.pcd"), std::string::npos);
  writePcd(job_.files[3], DatasetCloud{});
  EXPECT_EQ(error(), job_.files[3] + ": cloud has no points");
  DatasetCloud far_away = clouds_[3];
  for (auto& point : far_away.points) point.x() += 1e8;
  writePcd(job_.files[3], far_away);
  EXPECT_EQ(error().find(job_.files[3] + ": found a point"), 0U) << error();
}

TEST(Overlap, OfTwoCloudsIsThatOfTheFormula) {
  const DatasetCloud a = someCloud(1, 0.0);
  const DatasetCloud b = someCloud(2, 1.0);
  EXPECT_EQ(computeOverlap(a, b, 0.2), overlapByForce(a, b, 0.2));
  EXPECT_EQ(computeOverlap(a, a, 0.2), 1.0);
  EXPECT_EQ(computeOverlap(a, DatasetCloud{}, 0.2), 0.0);
  EXPECT_THROW(computeOverlap(DatasetCloud{}, a, 0.2), InvalidProblem);
  EXPECT_THROW(computeOverlap(a, b, -0.2), InvalidParameter);
}

TEST(Overlap, OfRealScansIsThatOfTheirProblemFile) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string folder = pcrb_test::sharedData() + "/benchmark/automotive/street/";
  const DatasetCloud source = readPcd(folder + "scan0.pcd");
  const DatasetCloud target = readPcd(folder + "scan1.pcd");
  EXPECT_NEAR(computeOverlap(source, target, 0.3), 0.9302, 1e-3);
}

}  // namespace
}  // namespace pcrb
