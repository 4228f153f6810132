#include "bridge/convergence_monitor.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

ScanAnswer at(int scan, double x, double yaw = 0.0) {
  ScanAnswer answer;
  answer.scan = scan;
  answer.T_map_body =
      Eigen::Translation3d(x, 0, 0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  return answer;
}

AcceptanceRule rule(AcceptanceRule::Kind kind, int count = 3) {
  AcceptanceRule rule;
  rule.kind = kind;
  rule.count = count;
  return rule;
}

const Transform kInitialPose = at(0, 1.0).T_map_body;

TEST(ConvergenceMonitor, FirstTakesTheFirstAnswer) {
  ConvergenceMonitor settling(rule(AcceptanceRule::Kind::kFirst), std::nullopt);
  EXPECT_FALSE(settling.isSettled());
  EXPECT_TRUE(settling.add(at(1, 5.0)));
  EXPECT_TRUE(settling.isSettled());
  EXPECT_EQ(settling.latest()->T_map_body.translation().x(), 5.0);
}

TEST(ConvergenceMonitor, DropsAFirstAnswerThatEchoesTheInitialPose) {
  ConvergenceMonitor settling(rule(AcceptanceRule::Kind::kFirst), kInitialPose);
  EXPECT_FALSE(settling.add(at(1, 1.0 + 1e-6)));
  EXPECT_FALSE(settling.isSettled());
  EXPECT_TRUE(settling.hasEchoed());
  EXPECT_FALSE(settling.latest());
}

TEST(ConvergenceMonitor, TakesTheSecondAnswerEvenIfItIsTheInitialPose) {
  ConvergenceMonitor settling(rule(AcceptanceRule::Kind::kFirst), kInitialPose);
  settling.add(at(1, 1.0));
  EXPECT_TRUE(settling.add(at(2, 1.0)));
  EXPECT_TRUE(settling.isSettled());
}

TEST(ConvergenceMonitor, TakesTheAnswerThatFollowsTheEchoOfTheSameScan) {
  ConvergenceMonitor settling(rule(AcceptanceRule::Kind::kFirst), kInitialPose);
  settling.add(at(1, 1.0));
  EXPECT_TRUE(settling.add(at(1, 1.5)));
  EXPECT_EQ(settling.latest()->T_map_body.translation().x(), 1.5);
}

TEST(ConvergenceMonitor, NthCountsScansAndNotMessages) {
  ConvergenceMonitor settling(rule(AcceptanceRule::Kind::kNth, 2), std::nullopt);
  settling.add(at(1, 5.0));
  settling.add(at(1, 5.1));
  EXPECT_FALSE(settling.isSettled());
  settling.add(at(2, 5.2));
  EXPECT_TRUE(settling.isSettled());
  EXPECT_EQ(settling.count(), 2);
}

TEST(ConvergenceMonitor, DropsAnAnswerToAnOlderScan) {
  ConvergenceMonitor settling(rule(AcceptanceRule::Kind::kNth, 3), std::nullopt);
  settling.add(at(2, 5.0));
  EXPECT_FALSE(settling.add(at(1, 9.0)));
  EXPECT_EQ(settling.latest()->scan, 2);
  EXPECT_EQ(settling.count(), 1);
}

TEST(ConvergenceMonitor, StableWantsAllOfTheLastAnswersNearTheNewest) {
  ConvergenceMonitor settling(rule(AcceptanceRule::Kind::kStable, 3), std::nullopt);
  // Each step is below the tolerance of 0.01, two of them are not.
  for (int scan = 1; scan <= 6; ++scan) {
    settling.add(at(scan, 0.008 * scan));
    EXPECT_FALSE(settling.isSettled()) << scan;
  }
  settling.add(at(7, 0.048));
  EXPECT_TRUE(settling.isSettled());
}

TEST(ConvergenceMonitor, StableLooksAtTheRotationToo) {
  ConvergenceMonitor settling(rule(AcceptanceRule::Kind::kStable, 2), std::nullopt);
  settling.add(at(1, 5.0, 0.1));
  settling.add(at(2, 5.0, 0.2));
  EXPECT_FALSE(settling.isSettled());
  settling.add(at(3, 5.0, 0.2));
  EXPECT_TRUE(settling.isSettled());
}

TEST(ConvergenceMonitor, DeadlineNeverSettlesBeforeIt) {
  ConvergenceMonitor settling(rule(AcceptanceRule::Kind::kDeadline), std::nullopt);
  for (int scan = 1; scan < 50; ++scan) settling.add(at(scan, 5.0));
  EXPECT_FALSE(settling.isSettled());
  EXPECT_EQ(settling.latest()->scan, 49);
}

}  // namespace
}  // namespace pcrb
