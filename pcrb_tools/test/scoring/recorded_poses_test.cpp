#include "scoring/recorded_poses.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>

#include <cmath>

#include "pcrb_core/error.hpp"
#include "support/bag_writer.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using pcrb_test::BagWriter;
using pcrb_test::expectError;

class RecordedPosesTest : public ::testing::Test {
 protected:
  std::vector<RecordedPose> readTable(const std::string& text) const {
    pcrb_test::writeFile(folder_.file("poses.txt"), text);
    return readPoseTable(folder_.file("poses.txt"));
  }

  /// That it is pose_, to the bit.
  void expectPose(const pcrb::Submission& submission) const {
    EXPECT_EQ(submission.position, Eigen::Vector3d(pose_.position.x, pose_.position.y, 0.0));
    EXPECT_EQ(submission.orientation.coeffs(),
              Eigen::Vector4d(0.0, 0.0, pose_.orientation.z, pose_.orientation.w));
  }

  geometry_msgs::Pose pose_ = [] {
    geometry_msgs::Pose pose;
    pose.position.x = 1.5;
    pose.position.y = -2.5;
    pose.orientation.z = 0.6;
    pose.orientation.w = 0.8;
    return pose;
  }();
  pcrb_test::TemporaryFolder folder_;
};

TEST_F(RecordedPosesTest, TumsRowsAreTakenAsTheyAre) {
  const auto poses =
      readTable("# comment\n\n1311878220.37 1.5 -2.5 0 0 0 0.6 0.8\r\n7 0 0 0 0 0 0 2");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].label, "1311878220.37");
  expectPose(poses[0].reply.submission);
  EXPECT_EQ(poses[1].reply.submission.orientation.w(), 2.0);  // refused where it is scored
  EXPECT_EQ(poses[1].reply.defect, "");
}

TEST_F(RecordedPosesTest, MatricesBecomeQuaternions) {
  const auto poses = readTable("12 0.28 -0.96 0 1.5 0.96 0.28 0 -2.5 0 0 1 0");
  const auto& pose = poses.at(0).reply.submission;
  EXPECT_EQ(pose.position, Eigen::Vector3d(1.5, -2.5, 0.0));
  EXPECT_NEAR(pose.orientation.z(), 0.6, 1e-15);
  EXPECT_NEAR(pose.orientation.w(), 0.8, 1e-15);
}

TEST_F(RecordedPosesTest, MatricesWithSixDecimalsAreRotations) {
  EXPECT_EQ(readTable("12 0.877583 -0.479426 0 0 0.479426 0.877583 0 0 0 0 1 0")[0].reply.defect,
            "");
}

TEST_F(RecordedPosesTest, KeepsMatricesThatAreNoRotationsWithTheirDefect) {
  for (const char* text : {"12 1 0 0 0 0 1 0 0 0 0 1.01 0", "12 -1 0 0 0 0 1 0 0 0 0 1 0",
                           "12 nan 0 0 0 0 1 0 0 0 0 1 0"}) {
    EXPECT_NE(readTable(text).at(0).reply.defect, "") << text;
  }
}

TEST_F(RecordedPosesTest, RowsOfAnotherFormAreErrors) {
  expectError<pcrb::InvalidFile>([&] { readTable("1 2 3\n"); }, "poses.txt:1: found 3 words");
  expectError<pcrb::InvalidFile>([&] { readTable("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1;\n"); },
                                 "poses.txt:2: found '1;', expected a number");
  expectError<pcrb::InvalidFile>([&] { readTable("# nothing\n"); }, "found no pose");
}

TEST_F(RecordedPosesTest, BagsMayHoldFourTypesOfPoses) {
  const std::string path = folder_.file("poses.bag");
  {
    const auto header = pcrb_test::headerAt(1000000000, 5, "/map");
    geometry_msgs::PoseStamped stamped;
    geometry_msgs::PoseWithCovarianceStamped covariant;
    nav_msgs::Odometry odometry;
    geometry_msgs::TransformStamped transform;
    stamped.header = covariant.header = odometry.header = transform.header = header;
    stamped.pose = covariant.pose.pose = odometry.pose.pose = pose_;
    covariant.pose.covariance[35] = odometry.pose.covariance[35] = 0.25;
    transform.transform.translation.x = pose_.position.x;
    transform.transform.translation.y = pose_.position.y;
    transform.transform.rotation = pose_.orientation;
    BagWriter(path)
        .add("/stamped", stamped)
        .add("/covariant", covariant)
        .add("/odometry", odometry)
        .add("/transform", transform);
  }
  for (const std::string topic : {"/stamped", "/covariant", "/odometry", "/transform"}) {
    const auto poses = readPoses(path, topic, "map");
    ASSERT_EQ(poses.size(), 1U) << topic;
    EXPECT_EQ(poses[0].stamp, 1000000000 * pcrb::kSecond + 5);
    expectPose(poses[0].reply.submission);
    const bool has_covariance = topic == "/covariant" || topic == "/odometry";
    const auto& covariance = poses[0].reply.submission.covariance;
    EXPECT_EQ(covariance.has_value(), has_covariance) << topic;
    EXPECT_EQ(covariance.value_or(pcrb::PoseCovariance{})[35], has_covariance ? 0.25 : 0.0);
  }
  expectError<pcrb::InvalidFile>([&] { readPoses(path, "/pose", "map"); },
                                 "no message on `/pose` among the topics");
  expectError<pcrb::InvalidFile>([&] { readPoses(path, "/stamped", "odom"); },
                                 "found a pose in the frame `/map`, expected `odom`");
  expectError<pcrb::InvalidParameter>([&] { readPoses(path, "", "map"); }, "found no --topic");
}

TEST_F(RecordedPosesTest, OtherTypesAreErrors) {
  const std::string path = folder_.file("clouds.bag");
  BagWriter(path).add("/scan", pcrb_test::makeCloud(pcrb_test::headerAt(1, 0, "map"), {1, 2, 3}));
  expectError<pcrb::InvalidFile>([&] { readPoses(path, "/scan", "map"); },
                                 "found sensor_msgs/PointCloud2, expected geometry_msgs");
}

}  // namespace
}  // namespace pcrb_tools
