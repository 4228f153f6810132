#include "pcrb_core/pose_covariance.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

Transform pose(double x, double y, double z, double yaw) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

TEST(PoseCovariance, ATurnOfTheBodyMovesASensorThatIsMountedAwayFromIt) {
  PoseCovariance body{};
  body[0] = 0.01;   // x
  body[35] = 0.04;  // yaw
  const auto sensor = mountedCovariance(body, pose(5, 5, 0, 0), pose(3, 0, 1, 0));
  EXPECT_NEAR(sensor[0], 0.01, 1e-12);
  EXPECT_NEAR(sensor[7], 0.04 * 9, 1e-12);      // y: 3 m ahead of the axis of the yaw
  EXPECT_NEAR(sensor[6 + 5], 0.04 * 3, 1e-12);  // y with yaw
  EXPECT_NEAR(sensor[35], 0.04, 1e-12);
}

TEST(PoseCovariance, ACovarianceMovedToAMountedFrameAndBackIsTheSame) {
  PoseCovariance sensor{};
  for (std::size_t i = 0; i < 6; ++i) sensor[7 * i] = 1e-4 * static_cast<double>(i + 1);
  const Transform T_map_sensor = pose(1, 0, 1.9, 0.3);
  const Transform E = pose(0.4, 0, 1.9, M_PI);
  const auto body = mountedCovariance(sensor, T_map_sensor, E.inverse());
  const auto again = mountedCovariance(body, T_map_sensor * E.inverse(), E);
  for (std::size_t i = 0; i < 36; ++i) EXPECT_NEAR(again[i], sensor[i], 1e-15);
  EXPECT_GT(body[0], 1e-3);
}

TEST(PoseCovariance, ATurnedParentExchangesTheAxesOfBothBlocksOfACovariance) {
  PoseCovariance odom{};
  for (std::size_t i = 0; i < 6; ++i) odom[7 * i] = static_cast<double>(i + 1);
  odom[5] = odom[30] = 0.5;  // x with yaw
  const auto map = rotatedCovariance(odom, pose(7, 8, 9, M_PI / 2).linear());
  EXPECT_NEAR(map[0], 2, 1e-12);
  EXPECT_NEAR(map[7], 1, 1e-12);
  EXPECT_NEAR(map[21], 5, 1e-12);
  EXPECT_NEAR(map[28], 4, 1e-12);
  EXPECT_NEAR(map[35], 6, 1e-12);
  EXPECT_NEAR(map[6 + 5], 0.5, 1e-12);  // y with yaw
}

}  // namespace
}  // namespace pcrb
