#include "pcrb_core/datasets/kaist.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>

#include "pcrb_core/error.hpp"
#include "support/decimal_comma.hpp"
#include "support/expect_error.hpp"
#include "support/shared_data.hpp"

namespace pcrb {
namespace {

const char* const kCalibration =
    "Left Velodyne (VLP-16) extrinsic calibration parameter from vehicle\r\n"
    "RPY(roll/pitch/yaw, degree), R(rotation matrix), T(translation matrix)\r\n"
    "RPY: 1.69162 44.9466 136.579\r\n"
    "R: -0.514066 -0.702201 -0.492595 0.486485 -0.711672 0.506809 -0.706447 0.0208933 0.707457\r\n"
    "T: -0.440699 0.397052 1.90953\r\n";

const char* const kGlobalPoses =
    "1519102894400000000,0,-1,0,332100.125,1,0,0,4140500.25,0,0,1,21.5\n"
    "1519102894410000000, 0, -1, 0, 332101.125, 1, 0, 0, 4140500.25, 0, 0, 1, 21.5\r\n";

/// 1, -2, 0.5 with intensity 9, little-endian.
const std::string kRecord("\x00\x00\x80\x3f\x00\x00\x00\xc0\x00\x00\x00\x3f\x00\x00\x10\x41", 16);
const std::string kOriginRecord(16, '\0');

TEST(VelodyneScan, RecordsAreFourLittleEndianFloats) {
  const SensorScan scan = parseVelodyneScan(kRecord, OriginPoints::kDrop, "1.bin");
  ASSERT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.points[0], Eigen::Vector3d(1, -2, 0.5));
}

TEST(VelodyneScan, ReturnsAtTheOriginAreDroppedOrKeptAndCounted) {
  const std::string bytes = kOriginRecord + kRecord;
  const SensorScan dropped = parseVelodyneScan(bytes, OriginPoints::kDrop, "1.bin");
  EXPECT_EQ(dropped.points.size(), 1u);
  EXPECT_EQ(dropped.counts.at_origin, 1u);
  EXPECT_EQ(dropped.counts.read, 2u);
  EXPECT_EQ(parseVelodyneScan(bytes, OriginPoints::kKeep, "1.bin").points.size(), 2u);
}

TEST(VelodyneScan, HasNoRecordMoreThanTheFile) {
  // `while (!eof())` would read one more.
  EXPECT_EQ(parseVelodyneScan(kRecord + kRecord, OriginPoints::kDrop, "1.bin").counts.read, 2u);
  EXPECT_EQ(parseVelodyneScan("", OriginPoints::kDrop, "1.bin").counts.read, 0u);
}

TEST(VelodyneScan, RejectsASizeThatIsNoMultipleOfSixteen) {
  PCRB_EXPECT_ERROR(InvalidFile, parseVelodyneScan(kRecord + "abc", OriginPoints::kDrop, "1.bin"),
                    "1.bin: found 19 bytes");
}

TEST(VelodyneScan, NonFiniteReturnsAreCounted) {
  std::string bytes = kRecord;
  bytes[2] = '\x80';
  bytes[3] = '\x7f';  // infinity
  EXPECT_EQ(parseVelodyneScan(bytes, OriginPoints::kDrop, "1.bin").counts.non_finite, 1u);
}

TEST(VelodyneScan, RejectsRecordsOfAnotherLengthByTheirValues) {
  const auto bytesOf = [](const std::vector<float>& values) {
    return std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size());
  };
  std::vector<float> four, three, five;
  for (int i = 0; i < 400; ++i) {
    const float x = static_cast<float>(i) - 200.0F, y = 30.0F - static_cast<float>(i), z = -1.7F;
    four.insert(four.end(), {x, y, z, 12.0F});
    three.insert(three.end(), {x, y, z});
    five.insert(five.end(), {x, y, z, 12.0F, 3.0F});
  }
  EXPECT_EQ(parseVelodyneScan(bytesOf(four), OriginPoints::kKeep, "1.bin").points.size(), 400u);
  for (const auto* values : {&three, &five}) {
    PCRB_EXPECT_ERROR(InvalidFile,
                      parseVelodyneScan(bytesOf(*values), OriginPoints::kKeep, "1.bin"),
                      "a negative intensity, expected records of 16 bytes");
  }
}

TEST(KaistStamps, AreIntegersOfNanoseconds) {
  const auto stamps = parseKaistStamps("1519102894479453001\r\n\n 1519102894579453257 \n", "s.csv");
  ASSERT_EQ(stamps.size(), 2u);
  EXPECT_EQ(stamps[0], 1519102894479453001);  // a double would give …453056
  PCRB_EXPECT_ERROR(InvalidFile, parseKaistStamps("1\n1.5e18\n", "s.csv"),
                    "s.csv:2: found '1.5e18'");
  PCRB_EXPECT_ERROR(InvalidFile, parseKaistStamps("-1\n", "s.csv"), "s.csv:1: ");
}

TEST(KaistCalibration, TakesRAndNotRpy) {
  const Transform T = parseKaistCalibration(kCalibration, "Vehicle2LeftVLP.txt");
  EXPECT_EQ(T.linear()(0, 0), -0.514066);
  EXPECT_EQ(T.linear()(0, 1), -0.702201);
  EXPECT_EQ(T.linear()(2, 0), -0.706447);
  EXPECT_EQ(T.translation(), Eigen::Vector3d(-0.440699, 0.397052, 1.90953));
}

TEST(KaistCalibration, RejectsDefectsNamingTheLine) {
  const auto expectError = [](const std::string& text, const char* message) {
    PCRB_EXPECT_ERROR(InvalidFile, parseKaistCalibration(text, "c.txt"), message);
  };
  expectError("R: 1 0 0 0 1 0 0 0\nT: 1 2 3\n", "c.txt:1: found 8 numbers");
  expectError("R: 1 0 0 0 1 0 0 0 2\nT: 1 2 3\n", "c.txt:1: found a matrix");
  expectError("R: 1 0 0 0 1 0 0 0 1\nT: 1 2\n", "c.txt:2: found 2 numbers");
  expectError("RPY: 1 0 0 0 1 0 0 0 1\nT: 1 2 3\n", "c.txt: found no line 'R:'");
  expectError("R: 1 0 0 0 1 0 0 0 1\n", "c.txt: found no line 'T:'");
  expectError("R: 1 0 0 0 1 0 0 0 1\nR: 1 0 0 0 1 0 0 0 1\nT: 1 2 3\n", "c.txt:2: found the same");
  expectError("R: 1 0 0 0 1 0 0 0 1\nT: 1 2 x\n", "c.txt:2: ");
  expectError("R:\nT: 1 2 3\n", "c.txt:1: found 0 numbers");
}

TEST(KaistCalibration, ReadsARealFile) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string path = pcrb_test::sharedData() + "/kaist/calibration/Vehicle2LeftVLP.txt";
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const Transform T = parseKaistCalibration(text, path);
  EXPECT_EQ(T.translation(), Eigen::Vector3d(-0.440699, 0.397052, 1.90953));
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-5);
}

TEST(KaistTrajectory, KeepsUtmInDouble) {
  const Trajectory trajectory = parseKaistTrajectory(kGlobalPoses, "global_pose.csv");
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory.nearest(0).T_world_body.translation(),
            Eigen::Vector3d(332100.125, 4140500.25, 21.5));
  EXPECT_EQ(trajectory.nearest(0).T_world_body.linear()(0, 1), -1.0);
}

TEST(KaistTrajectory, RejectsDefectsNamingTheLine) {
  const auto expectError = [](const std::string& text, const char* message) {
    PCRB_EXPECT_ERROR(InvalidFile, parseKaistTrajectory(text, "p.csv"), message);
  };
  expectError(std::string(kGlobalPoses) + "1519102894420000000,0,-1,0,1,1,0,0,4,0,0,1\n",
              "p.csv:3: found 11 numbers");
  expectError("1.5e18,0,-1,0,1,1,0,0,4,0,0,1,2\n", "p.csv:1: ");
  expectError("12\n", "p.csv:1: ");
  expectError("12,0,-1,0,1,1,0,0,4,0,0,1.1,2\n", "p.csv:1: found a matrix");
  expectError("12,0,-1,0,1,1,0,0,4,0,0,1 1,2\n", "p.csv:1: ");
  expectError("\n", "p.csv: found no pose");
}

TEST(KaistPose, IsTheClosestOneOrInterpolatedOnRequestWithTheOffsetAdded) {
  const Trajectory trajectory = parseKaistTrajectory(kGlobalPoses, "p.csv");
  const Stamp stamp = 1519102894404000000;
  KaistOptions options;
  EXPECT_EQ(kaistPose(trajectory, stamp, options).T_world_body.translation().x(), 332100.125);
  options.interpolate = true;
  EXPECT_NEAR(kaistPose(trajectory, stamp, options).T_world_body.translation().x(), 332100.525,
              1e-8);
  options.frame_offset = {1000.0, 2000.0, -3.0};
  EXPECT_NEAR(kaistPose(trajectory, stamp, options).T_world_body.translation().x(), 333100.525,
              1e-8);
}

TEST(KaistPose, ScansBeforeTheFirstPoseHaveNone) {
  const Trajectory trajectory = parseKaistTrajectory(kGlobalPoses, "p.csv");
  EXPECT_EQ(kaistPose(trajectory, 1519102894399999999, {}).status, PoseStatus::kBeforeFirst);
  EXPECT_EQ(kaistPose(trajectory, 1519102894900000000, {}).status, PoseStatus::kAfterLast);
}

TEST(ClosestStamp, PrefersTheEarlierOfTwoAtTheSameDistance) {
  const std::vector<Stamp> stamps = {10, 20, 40};
  EXPECT_EQ(closestStamp(stamps, 0), 10);
  EXPECT_EQ(closestStamp(stamps, 15), 10);
  EXPECT_EQ(closestStamp(stamps, 16), 20);
  EXPECT_EQ(closestStamp(stamps, 99), 40);
}

TEST(MergeScans, EqualsANaiveComputationAtUtmMagnitude) {
  const Transform T_vehicle_sensor = parseKaistCalibration(kCalibration, "c.txt");
  const Trajectory trajectory = parseKaistTrajectory(kGlobalPoses, "p.csv");
  const Transform left_pose = trajectory.nearest(0).T_world_body;
  const Transform right_pose = trajectory.nearest(std::numeric_limits<Stamp>::max()).T_world_body;
  const SensorScan scan = parseVelodyneScan(kRecord, OriginPoints::kDrop, "1.bin");
  const DatasetCloud cloud =
      mergeScans({scan, left_pose, T_vehicle_sensor}, {scan, right_pose, T_vehicle_sensor});
  ASSERT_EQ(cloud.points.size(), 2u);
  const double p[3] = {1.0, -2.0, 0.5};
  for (int i = 0; i < 2; ++i) {
    const Transform& pose = i == 0 ? left_pose : right_pose;
    for (int row = 0; row < 3; ++row) {
      double naive = pose(row, 3);
      for (int k = 0; k < 3; ++k) {
        double vehicle = T_vehicle_sensor(k, 3);
        for (int j = 0; j < 3; ++j) vehicle += T_vehicle_sensor(k, j) * p[j];
        naive += pose(row, k) * vehicle;
      }
      EXPECT_NEAR(cloud.points[static_cast<std::size_t>(i)][row], naive, 1e-8);
    }
  }
  EXPECT_LT(
      (cloud.viewpoint.translation() - left_pose * Eigen::Vector3d(T_vehicle_sensor.translation()))
          .norm(),
      1e-9);
  const Eigen::Matrix3d R = cloud.viewpoint.linear();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(KaistNames, CloudIsNamedByTheLeftStamp) {
  EXPECT_EQ(kaistCloudName("urban05", 1519102894479453000), "urban05_1519102894479453000.pcd");
}

TEST(KaistNames, SequenceOfAFolderOrArchive) {
  EXPECT_EQ(kaistSequenceName("urban05-highway"), "urban05");
  EXPECT_EQ(kaistSequenceName("urban05_data.tgz"), "urban05");
  EXPECT_EQ(kaistSequenceName("urban05"), "urban05");
  for (const char* name : {"urban", "urban-05", "suburban05", ""}) {
    EXPECT_EQ(kaistSequenceName(name), "") << name;
  }
}

TEST(KaistFiles, AreReadAlikeUnderALocaleWithDecimalComma) {
  const pcrb_test::DecimalComma comma;
  EXPECT_EQ(parseKaistCalibration(kCalibration, "c.txt").translation().z(), 1.90953);
  EXPECT_EQ(parseKaistTrajectory(kGlobalPoses, "p.csv").nearest(0).T_world_body.translation().z(),
            21.5);
  EXPECT_EQ(kaistCloudName("urban05", 1519102894479453000), "urban05_1519102894479453000.pcd");
}

}  // namespace
}  // namespace pcrb
