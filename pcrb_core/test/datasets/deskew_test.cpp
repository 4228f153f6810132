#include "pcrb_core/datasets/deskew.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pcrb_core/datasets/stamp_mismatch.hpp"

namespace pcrb {
namespace {

constexpr Stamp kStart = 1'500'000'000 * kSecond;

/// A sensor that drives along x with 10 m/s from kStart on, for a second.
PoseLookup drive(Stamp stamp) {
  PoseLookup pose;
  if (stamp > kStart + kSecond) return {PoseStatus::kAfterLast, {}};
  pose.status = PoseStatus::kFound;
  pose.T_world_body.translation().x() = 10.0 * static_cast<double>(stamp - kStart) / 1e9;
  return pose;
}

SensorScan wallAt5m(const std::vector<double>& times) {
  SensorScan scan;
  for (const double time : times) {
    scan.add({5.0 - 10.0 * time, 1.0, 0.0}, OriginPoints::kKeep);  // as seen on the way
    scan.times.push_back(time);
  }
  return scan;
}

TEST(Deskew, PointsOfOnePlaceSeenOnTheWayComeTogether) {
  DatasetCloud cloud;
  ASSERT_EQ(placeMovingScan(wallAt5m({0.0, 0.05, 0.1}), kStart, drive, cloud), PoseStatus::kFound);
  ASSERT_EQ(cloud.points.size(), 3u);
  for (const auto& point : cloud.points) {
    EXPECT_LT((point - Eigen::Vector3d(5, 1, 0)).norm(), 1e-9);
  }
  EXPECT_TRUE(cloud.viewpoint.translation().isZero());
}

TEST(Deskew, TimesSince1970AreTakenAsSuch) {
  EXPECT_EQ(pointStamp(kStart, 0.25), kStart + kSecond / 4);
  EXPECT_EQ(pointStamp(kStart, -0.1), kStart - kSecond / 10);
  EXPECT_EQ(pointStamp(kStart, 1.5e9 + 0.25), kStart + kSecond / 4);
  for (const double unit : {1e3, 1e6, 1e9}) {  // ms, µs and ns in a double
    EXPECT_NEAR(static_cast<double>(pointStamp(0, (1.5e9 + 0.25) * unit) - kStart), 0.25e9, 1e3);
  }
  for (const double no_time : {std::nan(""), 1e300, -1e300}) {
    EXPECT_EQ(pointStamp(kStart, no_time), std::numeric_limits<Stamp>::max() / 2);
  }
}

TEST(Deskew, AScanThatThePosesDoNotCoverIsNone) {
  DatasetCloud cloud;
  EXPECT_EQ(placeMovingScan(wallAt5m({0.0, 1.5}), kStart, drive, cloud), PoseStatus::kAfterLast);
}

TEST(StampMismatch, GuessesUnitsIndicesAndClocks) {
  const std::vector<Stamp> scans{kStart, kStart + kSecond};
  const auto says = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(describeMismatch(scans, {kStart / 1'000'000'000, kStart / 1'000'000'000 + 1}),
       "are the poses' timestamps seconds that were taken as nanoseconds?");
  says(describeMismatch(scans, {0, kSecond}), "indices, or since the start?");
  says(describeMismatch({0, kSecond}, scans), "are the scans' timestamps indices?");
  says(describeMismatch({kStart + 5 * kSecond}, {kStart, kStart + 9 * kSecond}),
       "are the poses too far apart?");
  const std::string shifted = describeMismatch(scans, {kStart + 3600 * kSecond});
  says(shifted, "scans from 1500000000.000 to 1500000001.000 s, poses from 1500003600.000");
  says(shifted, "the nearest pose is 3599.000000 s from a scan");
  says(shifted, "a constant -3600.000 s added to the poses' timestamps");
}

}  // namespace
}  // namespace pcrb
