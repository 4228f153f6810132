#include "bridge/frames.hpp"

#include <gtest/gtest.h>

#include "bridge/robot_inputs.hpp"

namespace pcrb {
namespace {

Transform pose(double x, double y, double z, double roll, double pitch, double yaw) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

TEST(Frames, SensorPoseUndoesBodyPose) {
  const Transform T_map_sensor = pose(310, -47, 3, 0.1, -0.2, 2.9);
  const Transform E = pose(0.4, 0, 1.9, 0, 0.17, M_PI);
  EXPECT_TRUE(sensorPose(bodyPose(T_map_sensor, E), E).isApprox(T_map_sensor, 1e-14));
}

TEST(Frames, ASensorMountedAboveTheBodyIsAboveItInTheMap) {
  const Transform E = pose(0, 0, 1.9, 0, 0, M_PI);
  const Transform T_map_body = bodyPose(pose(10, 20, 1.9, 0, 0, 0), E);
  EXPECT_TRUE(T_map_body.isApprox(pose(10, 20, 0, 0, 0, -M_PI), 1e-12));
}

TEST(Frames, AnOpticalFramesViewingDirectionBecomesX) {
  const Transform T = uprightFromOptical(std::nullopt);
  EXPECT_TRUE((T * Eigen::Vector3d(0, 0, 5)).isApprox(Eigen::Vector3d(5, 0, 0)));   // forward
  EXPECT_TRUE((T * Eigen::Vector3d(3, 0, 0)).isApprox(Eigen::Vector3d(0, -3, 0)));  // right
  EXPECT_TRUE((T * Eigen::Vector3d(0, 2, 0)).isApprox(Eigen::Vector3d(0, 0, -2)));  // down
}

TEST(Frames, ARolledOpticalFrameIsTurnedUpright) {
  const Transform T_map_body = pose(1, 2, 3, 0, 0.3, 1.1);  // looks down a little, level
  const Transform T_body_optical = uprightFromOptical(std::nullopt);
  const Transform T_map_optical =
      T_map_body * T_body_optical * Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ());
  const Transform T_upright_optical = uprightFromOptical(T_map_optical);
  EXPECT_TRUE(bodyPose(T_map_optical, T_upright_optical).isApprox(T_map_body, 1e-12));
}

TEST(StampClock, NeverGivesAStampTwice) {
  StampClock clock(true);
  EXPECT_EQ(clock.now(1000), 1000);
  EXPECT_EQ(clock.now(1000), 1001);
  EXPECT_EQ(clock.now(900), 1002);
}

TEST(StampClock, EvenStampsFollowByTheSpacingHoweverLateTheScan) {
  StampClock clock(true);
  clock.now(1000);
  EXPECT_EQ(clock.next(5000, 100), 1100);
  EXPECT_EQ(clock.next(9000, 100), 1200);
}

TEST(StampClock, OtherStampsAreTheTimesOfSending) {
  StampClock clock(false);
  clock.now(1000);
  EXPECT_EQ(clock.next(5000, 100), 5000);
  EXPECT_EQ(clock.next(4000, 100), 5001);
}

TEST(WarningOfTilt, IsForInitialPosesThatNoLocalProblemOfALevelSensorHas) {
  const auto tilted = [](double angle) {
    return Transform(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(angle, Eigen::Vector3d(0.6, 0.8, 0.0)));
  };
  EXPECT_EQ(warningOfTilt(Transform::Identity()), "");
  EXPECT_EQ(warningOfTilt(tilted(0.52)), "");
  EXPECT_NE(warningOfTilt(tilted(0.6)), "");
  EXPECT_NE(warningOfTilt(tilted(3.1)), "");
}

TEST(AdviceOn, TellsALocalizerOfTheSensorFromOneThatMountsIt) {
  const OwnedFrame sensor{"tf_base_scan", "base_link", true};
  EXPECT_EQ(adviceOn(sensor, "velodyne", "map"),
            "if it localizes the sensor itself, set base_frame:=velodyne and "
            "`tf_odom_base: none` in bridge_parameters");
  EXPECT_EQ(adviceOn(sensor, "velodyne", "base_link"),
            "or set `tf_base_scan: none` in bridge_parameters if the localizer publishes velodyne "
            "itself");
  const OwnedFrame body{"tf_odom_base", "odom", false};
  EXPECT_EQ(adviceOn(body, "base_link", "map"),
            "or set `tf_odom_base: none` in bridge_parameters if the localizer publishes base_link "
            "itself");
}

}  // namespace
}  // namespace pcrb
