#include "pcrb_core/datasets/trajectory.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr Stamp kMillisecond = kSecond / 1000;

/// At a second, at x metres, turned about z, with a quaternion of either sign.
StampedPose pose(double second, double x, double yaw) {
  StampedPose stamped;
  stamped.stamp = toStamp(second);
  stamped.T_world_body.translation().x() = x;
  stamped.T_world_body.linear() =
      Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return stamped;
}

double yawOf(const Transform& T) { return std::atan2(T.linear()(1, 0), T.linear()(0, 0)); }

TEST(Trajectory, InterpolatesTranslationLinearlyAndRotationAlongTheArc) {
  const Trajectory trajectory({pose(10.0, 1.0, 0.2), pose(10.1, 2.0, 0.6)});
  const PoseLookup answer = trajectory.interpolate(toStamp(10.025), kSecond);
  ASSERT_EQ(answer.status, PoseStatus::kFound);
  EXPECT_NEAR(answer.T_world_body.translation().x(), 1.25, 1e-12);
  EXPECT_NEAR(yawOf(answer.T_world_body), 0.3, 1e-12);
}

TEST(Trajectory, InterpolatesTheShortWayAroundPi) {
  const Trajectory trajectory({pose(1.0, 0.0, 3.1), pose(2.0, 0.0, -3.1)});
  const PoseLookup answer = trajectory.interpolate(toStamp(1.5), kSecond);
  EXPECT_NEAR(std::abs(yawOf(answer.T_world_body)), M_PI, 1e-9);
}

TEST(Trajectory, RefusesGapsBeyondTheLimitAndTimesOutside) {
  const Trajectory trajectory({pose(1.0, 0.0, 0.0), pose(1.1, 1.0, 0.0), pose(13.1, 2.0, 0.0)});
  EXPECT_EQ(trajectory.interpolate(toStamp(1.05), 100 * kMillisecond).status, PoseStatus::kFound);
  EXPECT_EQ(trajectory.interpolate(toStamp(1.05), 99 * kMillisecond).status, PoseStatus::kGap);
  EXPECT_EQ(trajectory.interpolate(toStamp(2.0), 100 * kMillisecond).status, PoseStatus::kGap);
  EXPECT_EQ(trajectory.interpolate(toStamp(0.9), kSecond).status, PoseStatus::kBeforeFirst);
  EXPECT_EQ(trajectory.interpolate(toStamp(13.2), kSecond).status, PoseStatus::kAfterLast);
}

TEST(Trajectory, APoseAtTheVeryStampIsFoundAtTheEdgeOfAGap) {
  const Trajectory trajectory({pose(1.0, 5.0, 0.0), pose(13.0, 7.0, 0.0)});
  const PoseLookup answer = trajectory.interpolate(toStamp(13.0), kMillisecond);
  ASSERT_EQ(answer.status, PoseStatus::kFound);
  EXPECT_EQ(answer.T_world_body.translation().x(), 7.0);
}

TEST(Trajectory, SortsAndKeepsTheLastOfPosesWithOneStamp) {
  const Trajectory trajectory({pose(2.0, 2.0, 0.0), pose(1.0, 1.0, 0.0), pose(2.0, 9.0, 0.0)});
  EXPECT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory.duplicates(), 1u);
  EXPECT_EQ(trajectory.interpolate(toStamp(2.0), kSecond).T_world_body.translation().x(), 9.0);
}

TEST(Trajectory, NearestPoseWithoutALimitIsAlwaysFound) {
  const Trajectory trajectory({pose(1.0, 1.0, 0.0), pose(2.0, 2.0, 0.0)});
  EXPECT_EQ(trajectory.nearest(0).T_world_body.translation().x(), 1.0);
  EXPECT_EQ(trajectory.nearest(toStamp(1.5)).T_world_body.translation().x(), 1.0);
  EXPECT_EQ(trajectory.nearest(toStamp(1.5) + 1).T_world_body.translation().x(), 2.0);
  EXPECT_EQ(trajectory.nearest(toStamp(99.0)).T_world_body.translation().x(), 2.0);
}

TEST(Trajectory, NearestPoseWithALimitSaysWhyThereIsNone) {
  const Trajectory trajectory({pose(1.0, 1.0, 0.0), pose(2.0, 2.0, 0.0)});
  const Stamp limit = 100 * kMillisecond;
  EXPECT_EQ(trajectory.nearest(toStamp(1.1), limit).status, PoseStatus::kFound);
  EXPECT_EQ(trajectory.nearest(toStamp(2.1), limit).status, PoseStatus::kFound);
  EXPECT_EQ(trajectory.nearest(toStamp(0.95), limit).status, PoseStatus::kBeforeFirst);
  EXPECT_EQ(trajectory.nearest(toStamp(1.5), limit).status, PoseStatus::kGap);
  EXPECT_EQ(trajectory.nearest(toStamp(2.2), limit).status, PoseStatus::kAfterLast);
}

TEST(Trajectory, NeedsAPose) { EXPECT_THROW(Trajectory({}), InvalidProblem); }

}  // namespace
}  // namespace pcrb
