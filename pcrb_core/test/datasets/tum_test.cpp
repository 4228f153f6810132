#include "pcrb_core/datasets/tum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/error.hpp"
#include "support/decimal_comma.hpp"
#include "support/expect_error.hpp"
#include "support/shared_data.hpp"

namespace pcrb {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const char* const kTrajectory =
    "# ground truth trajectory\n"
    "# timestamp tx ty tz qx qy qz qw\r\n"
    "1311868163.8697 -0.1357 -1.4217 1.4764 0.6453 -0.5498 0.3363 -0.4101\n"
    "\n"
    "1311868163.8731 -0.1359 -1.4219 1.4766 -0.6453 0.5498 -0.3363 0.4101\n";

TEST(TumTrajectory, ReadsPosesWithExactStampsAndNormalisedRotations) {
  const Trajectory trajectory = parseTrajectory(kTrajectory, "gt.txt").trajectory;
  EXPECT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory.firstStamp(), 1311868163869700000);
  const Transform T = trajectory.nearest(trajectory.firstStamp()).T_world_body;
  EXPECT_LT((T.linear().transpose() * T.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_EQ(T.translation(), Eigen::Vector3d(-0.1357, -1.4217, 1.4764));
}

TEST(TumTrajectory, AQuaternionThatFlipsItsSignIsNoTurn) {
  const Trajectory trajectory = parseTrajectory(kTrajectory, "gt.txt").trajectory;
  const Transform first = trajectory.nearest(0).T_world_body;
  const PoseLookup middle = trajectory.interpolate(trajectory.firstStamp() + 1700000, kSecond / 10);
  ASSERT_EQ(middle.status, PoseStatus::kFound);
  EXPECT_LT(rotationAngle(first.linear().transpose() * middle.T_world_body.linear()), 1e-9);
  EXPECT_NEAR(middle.T_world_body.translation().x(), -0.1358, 1e-9);
}

TEST(TumTrajectory, RejectsDefectsNamingTheLine) {
  const auto expectError = [](const std::string& text, const char* message) {
    PCRB_EXPECT_ERROR(InvalidFile, parseTrajectory(text, "gt.txt"), message);
  };
  expectError("# c\n1.5 1 2 3 0 0 1\n", "gt.txt:2: found '1.5 1 2 3 0 0 1' (7 fields)");
  expectError("1.5 1 2 3 0 0 0 1 9\n", "gt.txt:1: found '1.5 1 2 3 0 0 0 1 9' (9 fields)");
  expectError("1.5 1 2 3 0 0 0 0\n", "a quaternion of norm 0");
  expectError("1.5 1 2 3 0 0 0 2\n", "a quaternion of norm 2");
  expectError("1.5 1 2 nan 0 0 0 1\n", "found 'nan', expected a number");
  expectError("1.5 1 2 1,5 0 0 0 1\n", "gt.txt:1: ");
  expectError("1.3e 1 2 3 0 0 0 1\n", "gt.txt:1: ");
  expectError("1 0 0 1 0 1 0 2 0 0 1 3\n", "poses without timestamps (kitti)");
  expectError("# only a comment\n", "found no pose");
}

TEST(TumTrajectory, IsReadAlikeUnderALocaleWithDecimalComma) {
  const pcrb_test::DecimalComma comma;
  EXPECT_EQ(parseTrajectory(kTrajectory, "a").trajectory.nearest(0).T_world_body.translation().z(),
            1.4764);
}

TEST(TumTrajectory, RealFileHasADuplicateStampAndAGapOfTwelveSeconds) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string path = pcrb_test::sharedData() + "/tum/fr2_desk_groundtruth.txt";
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const Trajectory trajectory = parseTrajectory(text, path).trajectory;
  EXPECT_EQ(trajectory.size(), 20956u);  // 20960 lines, 3 comments, 1 stamp twice
  EXPECT_EQ(trajectory.duplicates(), 1u);
  const Stamp in_gap = *parseStamp("1311868200.0");
  EXPECT_EQ(trajectory.interpolate(in_gap, kSecond / 10).status, PoseStatus::kGap);
  EXPECT_EQ(trajectory.interpolate(in_gap, 13 * kSecond).status, PoseStatus::kFound);
  // Nowhere does a sign flip make a turn: within 20 ms the camera turns by less than 3 degrees.
  for (Stamp stamp = trajectory.firstStamp(); stamp < in_gap - 20 * kSecond; stamp += 20000000) {
    const PoseLookup a = trajectory.interpolate(stamp, kSecond);
    const PoseLookup b = trajectory.interpolate(stamp + 20000000, kSecond);
    if (a.status != PoseStatus::kFound || b.status != PoseStatus::kFound) continue;
    ASSERT_LT(rotationAngle(a.T_world_body.linear().transpose() * b.T_world_body.linear()), 0.05)
        << stamp;
  }
}

TEST(TumImageList, ReadsStampsAndPaths) {
  const auto images = parseTumImageList(
      "# depth maps\n1311868164.363181 depth/1311868164.363181.png\r\n", "depth.txt");
  ASSERT_EQ(images.size(), 1u);
  EXPECT_EQ(images[0].stamp, 1311868164363181000);
  EXPECT_EQ(images[0].path, "depth/1311868164.363181.png");
}

TEST(TumImageList, RejectsPathsThatLeaveTheFolder) {
  for (const char* path : {"../a.png", "/etc/passwd", "depth/../../a.png", "..", "a\\..\\b.png"}) {
    PCRB_EXPECT_ERROR(InvalidFile, parseTumImageList("1.5 " + std::string(path), "depth.txt"),
                      "depth.txt:1: ");
  }
}

TEST(TumImageList, RejectsDefectsNamingTheLine) {
  PCRB_EXPECT_ERROR(InvalidFile, parseTumImageList("#\n1.5\n", "depth.txt"), "depth.txt:2: ");
  PCRB_EXPECT_ERROR(InvalidFile, parseTumImageList("1.5 a.png b.png\n", "depth.txt"), "'a.png b");
  PCRB_EXPECT_ERROR(InvalidFile, parseTumImageList("x a.png\n", "depth.txt"), "a timestamp");
  PCRB_EXPECT_ERROR(InvalidFile, parseTumImageList("\n", "depth.txt"), "found no image");
}

/// Two rows of three pixels; each row followed by two bytes of padding.
const std::string kImage16("\x00\x00\x88\x13\x10\x27--\x01\x00\xff\xff\x00\x00--", 16);

DepthImage image16() {
  DepthImage image;
  image.width = 3;
  image.height = 2;
  image.row_bytes = 8;
  image.bytes = kImage16;
  return image;
}

TEST(DepthToScan, UnitsOfTheImageBecomeMetresAndZeroIsNoPoint) {
  const Intrinsics camera{500.0, 400.0, 1.0, 0.5};
  const SensorScan scan = depthToScan(image16(), camera, "a.png");
  ASSERT_EQ(scan.points.size(), 4u);
  EXPECT_EQ(scan.counts.read, 6u);
  EXPECT_EQ(scan.counts.non_finite, 2u);
  EXPECT_TRUE(scan.points[0].isApprox(Eigen::Vector3d(0.0, -0.5 / 400, 1.0), 1e-15));
  EXPECT_TRUE(scan.points[1].isApprox(Eigen::Vector3d(2.0 / 500, -1.0 / 400, 2.0), 1e-15));
  EXPECT_EQ(scan.points[3].z(), 65535 / 5000.0);
}

TEST(DepthToScan, BigEndianAndMillimetresAreRead) {
  DepthImage image = image16();
  image.big_endian = true;
  image.units_per_metre = 1000.0;
  EXPECT_EQ(depthToScan(image, {}, "a").points[0].z(), 0x8813 / 1000.0);
}

TEST(DepthToScan, FloatsAreMetresAndWhatIsNotInFrontOfTheCameraIsNoPoint) {
  const float depths[] = {
      1.5F, static_cast<float>(kNaN), 0.0F, -1.0F, std::numeric_limits<float>::infinity(), 0.1F};
  DepthImage image;
  image.width = 3;
  image.height = 2;
  image.row_bytes = 12;
  image.format = DepthFormat::kFloat32;
  image.bytes = {reinterpret_cast<const char*>(depths), sizeof(depths)};
  const SensorScan scan = depthToScan(image, {}, "a");
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.counts.non_finite, 4u);
  EXPECT_EQ(scan.points[1].z(), static_cast<double>(0.1F));
  EXPECT_NEAR(scan.points[1].x(), (2 - 319.5) * static_cast<double>(0.1F) / 525.0, 1e-15);
}

TEST(DepthToScan, RejectsSizesThatTheBytesDoNotFill) {
  DepthImage image = image16();
  image.height = 3;
  PCRB_EXPECT_ERROR(InvalidFile, depthToScan(image, {}, "a.png"), "a.png: found a depth image");
  image = image16();
  image.row_bytes = 5;
  EXPECT_THROW(depthToScan(image, {}, "a.png"), InvalidFile);
  image = image16();
  image.width = 0xffffffff;
  image.height = 0xffffffff;
  image.row_bytes = std::numeric_limits<std::size_t>::max();
  EXPECT_THROW(depthToScan(image, {}, "a.png"), InvalidFile);
  image = image16();
  image.width = 0;
  EXPECT_THROW(depthToScan(image, {}, "a.png"), InvalidFile);
}

TEST(DepthToScan, RejectsAnImpossibleCamera) {
  EXPECT_THROW(depthToScan(image16(), {0.0, 525.0, 319.5, 239.5}, "a"), InvalidParameter);
  EXPECT_THROW(depthToScan(image16(), {525.0, kNaN, 319.5, 239.5}, "a"), InvalidParameter);
  DepthImage image = image16();
  image.units_per_metre = 0.0;
  EXPECT_THROW(depthToScan(image, {}, "a"), InvalidParameter);
}

std::size_t keptOf(RateLimiter limiter, double step, int count) {
  std::size_t kept = 0;
  for (int i = 0; i < count; ++i) kept += limiter.keep(toStamp(step * i)) ? 1 : 0;
  return kept;
}

TEST(RateLimiter, ThinsThirtyHertzToTwoOnAverage) {
  EXPECT_EQ(keptOf(RateLimiter(2.0), 1.0 / 30.0, 299), 20u);  // 9.93 s
  EXPECT_EQ(keptOf(RateLimiter(2.0), 0.0337, 295), 20u);      // 9.91 s
}

TEST(RateLimiter, LeavesAStreamOfTheRateAloneDespiteJitter) {
  RateLimiter limiter(2.0);
  for (const double second : {0.0, 0.47, 1.02, 1.49, 2.0, 2.51}) {
    EXPECT_TRUE(limiter.keep(toStamp(second))) << second;
  }
}

TEST(RateLimiter, DoesNotCatchUpAfterAGap) {
  RateLimiter limiter(2.0);
  EXPECT_TRUE(limiter.keep(toStamp(0.0)));
  EXPECT_TRUE(limiter.keep(toStamp(12.0)));
  EXPECT_FALSE(limiter.keep(toStamp(12.1)));
  EXPECT_TRUE(limiter.keep(toStamp(12.5)));
}

TEST(RateLimiter, ThinsAStreamThatGoesBackAnew) {
  RateLimiter limiter(2.0);
  for (const double second : {8.0, 8.5, 9.0}) EXPECT_TRUE(limiter.keep(toStamp(second)));
  EXPECT_FALSE(limiter.keep(toStamp(8.9)));  // disorder
  EXPECT_TRUE(limiter.keep(toStamp(3.0)));
  EXPECT_FALSE(limiter.keep(toStamp(3.2)));
  EXPECT_TRUE(limiter.keep(toStamp(3.5)));
}

TEST(RateLimiter, ZeroKeepsEverythingAndNonsenseIsRejected) {
  EXPECT_EQ(keptOf(RateLimiter(0.0), 0.001, 50), 50u);
  EXPECT_THROW(RateLimiter(-2.0), InvalidParameter);
  EXPECT_THROW(RateLimiter{kNaN}, InvalidParameter);
}

TEST(TumNames, SequenceOfALog) {
  EXPECT_EQ(tumSequenceName("rgbd_dataset_freiburg2_pioneer_slam3-2hz-with-pointclouds"),
            "pioneer_slam3");
  EXPECT_EQ(tumSequenceName("rgbd_dataset_freiburg3_long_office_household"),
            "long_office_household");
  EXPECT_EQ(tumSequenceName("office"), "office");
}

}  // namespace
}  // namespace pcrb
