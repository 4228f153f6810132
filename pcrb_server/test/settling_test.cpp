#include "bridge/settling.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

PoseAnswer at(int scan, double x, double yaw = 0.0) {
  PoseAnswer answer;
  answer.scan = scan;
  answer.T_map_body =
      Eigen::Translation3d(x, 0, 0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  return answer;
}

SettlingRule rule(SettlingRule::Kind kind, int count = 3) {
  SettlingRule rule;
  rule.kind = kind;
  rule.count = count;
  return rule;
}

const Transform kStart = at(0, 1.0).T_map_body;

TEST(Settling, FirstTakesTheFirstAnswer) {
  Settling settling(rule(SettlingRule::Kind::kFirst), std::nullopt);
  EXPECT_FALSE(settling.isSettled());
  EXPECT_TRUE(settling.add(at(1, 5.0)));
  EXPECT_TRUE(settling.isSettled());
  EXPECT_EQ(settling.latest()->T_map_body.translation().x(), 5.0);
}

TEST(Settling, DropsAFirstAnswerThatEchoesTheInitialPose) {
  Settling settling(rule(SettlingRule::Kind::kFirst), kStart);
  EXPECT_FALSE(settling.add(at(1, 1.0 + 1e-6)));
  EXPECT_FALSE(settling.isSettled());
  EXPECT_TRUE(settling.hasEchoed());
  EXPECT_FALSE(settling.latest());
}

TEST(Settling, TakesTheSecondAnswerEvenIfItIsTheInitialPose) {
  Settling settling(rule(SettlingRule::Kind::kFirst), kStart);
  settling.add(at(1, 1.0));
  EXPECT_TRUE(settling.add(at(2, 1.0)));
  EXPECT_TRUE(settling.isSettled());
}

TEST(Settling, TakesTheAnswerThatFollowsTheEchoOfTheSameScan) {
  Settling settling(rule(SettlingRule::Kind::kFirst), kStart);
  settling.add(at(1, 1.0));
  EXPECT_TRUE(settling.add(at(1, 1.5)));
  EXPECT_EQ(settling.latest()->T_map_body.translation().x(), 1.5);
}

TEST(Settling, NthCountsScansAndNotMessages) {
  Settling settling(rule(SettlingRule::Kind::kNth, 2), std::nullopt);
  settling.add(at(1, 5.0));
  settling.add(at(1, 5.1));
  EXPECT_FALSE(settling.isSettled());
  settling.add(at(2, 5.2));
  EXPECT_TRUE(settling.isSettled());
  EXPECT_EQ(settling.count(), 2);
}

TEST(Settling, DropsAnAnswerToAnOlderScan) {
  Settling settling(rule(SettlingRule::Kind::kNth, 3), std::nullopt);
  settling.add(at(2, 5.0));
  EXPECT_FALSE(settling.add(at(1, 9.0)));
  EXPECT_EQ(settling.latest()->scan, 2);
  EXPECT_EQ(settling.count(), 1);
}

TEST(Settling, StableWantsAllOfTheLastAnswersNearTheNewest) {
  Settling settling(rule(SettlingRule::Kind::kStable, 3), std::nullopt);
  // Each step is below the tolerance of 0.01, two of them are not.
  for (int scan = 1; scan <= 6; ++scan) {
    settling.add(at(scan, 0.008 * scan));
    EXPECT_FALSE(settling.isSettled()) << scan;
  }
  settling.add(at(7, 0.048));
  EXPECT_TRUE(settling.isSettled());
}

TEST(Settling, StableLooksAtTheRotationToo) {
  Settling settling(rule(SettlingRule::Kind::kStable, 2), std::nullopt);
  settling.add(at(1, 5.0, 0.1));
  settling.add(at(2, 5.0, 0.2));
  EXPECT_FALSE(settling.isSettled());
  settling.add(at(3, 5.0, 0.2));
  EXPECT_TRUE(settling.isSettled());
}

TEST(Settling, DeadlineNeverSettlesBeforeIt) {
  Settling settling(rule(SettlingRule::Kind::kDeadline), std::nullopt);
  for (int scan = 1; scan < 50; ++scan) settling.add(at(scan, 5.0));
  EXPECT_FALSE(settling.isSettled());
  EXPECT_EQ(settling.latest()->scan, 49);
}

}  // namespace
}  // namespace pcrb
