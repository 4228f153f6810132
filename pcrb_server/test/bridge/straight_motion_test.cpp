#include "bridge/straight_motion.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

TEST(StraightMotion, StandsStillUntilItIsToldToGo) {
  const StraightMotion motion;
  EXPECT_EQ(motion.at(1e9).position, 0.0);
  EXPECT_EQ(motion.at(1e9).velocity, 0.0);
}

TEST(StraightMotion, SetsOffEvenlyAndBrakesAsItSetOff) {
  StraightMotion motion;
  motion.changeTo(0.5, 100.0);
  EXPECT_DOUBLE_EQ(motion.timeToSpeed(100.0), 0.25);
  EXPECT_NEAR(motion.at(100.1).velocity, 0.2, 1e-12);  // 100.1 is rounded
  EXPECT_DOUBLE_EQ(motion.at(100.1).acceleration, StraightMotion::kAcceleration);
  EXPECT_NEAR(motion.at(100.25).position, 0.0625, 1e-12);
  EXPECT_NEAR(motion.at(101.25).position, 0.5625, 1e-12);
  EXPECT_EQ(motion.at(101.25).acceleration, 0.0);
  motion.changeTo(0.0, 101.25);
  EXPECT_DOUBLE_EQ(motion.at(101.3).acceleration, -StraightMotion::kAcceleration);
  EXPECT_NEAR(motion.at(200.0).position, 0.625, 1e-12);
  EXPECT_EQ(motion.at(200.0).velocity, 0.0);
}

TEST(StraightMotion, HasAPositionThatIsTheIntegralOfItsVelocityThroughoutItsLife) {
  StraightMotion motion;
  constexpr double kStep = 1e-4;
  double position = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double time = kStep * i;
    if (i == 5000 || i == 16000) motion.changeTo(0.7, time);
    if (i == 6500 || i == 30000) motion.changeTo(0.0, time);  // once before it is reached
    const auto state = motion.at(time);
    EXPECT_NEAR(state.position, position, 1e-3) << time;
    position += kStep * state.velocity;
  }
}

}  // namespace
}  // namespace pcrb
