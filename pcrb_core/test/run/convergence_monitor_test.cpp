#include "pcrb_core/run/convergence_monitor.hpp"

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

ScanRecord stored(std::uint32_t scan, double x, bool is_echo = false) {
  ScanRecord record;
  record.scan = scan;
  record.answered = 0.1 * scan;
  record.is_echo = is_echo;
  record.position = Eigen::Vector3d(x, 0.0, 0.0);
  record.orientation = Eigen::Quaterniond::Identity();
  return record;
}

TEST(ReplayRule, SaysWhatEachRuleTakesOfTheSameAnswers) {
  std::vector<ScanRecord> scans{stored(1, 1.0, true), stored(2, 2.0),   stored(3, 5.0),
                                stored(4, 5.0),       stored(5, 5.001), stored(6, 7.0)};
  scans.insert(scans.begin() + 3, ScanRecord());  // without an answer
  const auto scanOf = [&](AcceptanceRule::Kind kind) {
    return replayRule(rule(kind), scans).answer->scan;
  };
  EXPECT_EQ(scanOf(AcceptanceRule::Kind::kFirst), 2u);
  EXPECT_EQ(scanOf(AcceptanceRule::Kind::kNth), 4u);
  EXPECT_EQ(scanOf(AcceptanceRule::Kind::kStable), 5u);
  EXPECT_EQ(scanOf(AcceptanceRule::Kind::kDeadline), 6u);
}

TEST(ReplayRule, TakesTheLastAnswerWhereNothingSettles) {
  const std::vector<ScanRecord> scans{stored(1, 1.0), stored(2, 2.0)};
  const RuleReplay stable = replayRule(rule(AcceptanceRule::Kind::kStable), scans);
  EXPECT_FALSE(stable.is_settled);
  EXPECT_EQ(stable.answer, &scans[1]);
  EXPECT_TRUE(replayRule(rule(AcceptanceRule::Kind::kDeadline), scans).is_settled);
  const RuleReplay nothing = replayRule(rule(AcceptanceRule::Kind::kFirst), {ScanRecord()});
  EXPECT_FALSE(nothing.is_settled);
  EXPECT_EQ(nothing.answer, nullptr);
}

}  // namespace
}  // namespace pcrb
