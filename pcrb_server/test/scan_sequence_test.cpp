#include "bridge/scan_sequence.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

using Action = ScanSequence::Action;
using Kind = SettlingRule::Kind;

constexpr double kStart = 100.0;                // s
constexpr std::int64_t kSpacing = 100'000'000;  // ns
constexpr std::int64_t kFirstStamp = 1'000'000'000'000;

class ScanSequenceTest : public testing::Test {
 protected:
  ScanSequence sequence(Kind kind, int count = 2) {
    SettlingRule rule;
    rule.kind = kind;
    rule.count = count;
    return ScanSequence(policy_, rule, std::nullopt, kStart);
  }

  static std::int64_t stamp(int scan) { return kFirstStamp + scan * kSpacing; }

  static void send(ScanSequence& sequence, double now) {
    sequence.scanSent(now, stamp(sequence.scansSent() + 1));
  }

  /// An answer of its own to each scan, so that nothing is stable.
  static bool answer(ScanSequence& sequence, int scan) {
    Transform T = Transform::Identity();
    T.translation().x() = scan;
    return sequence.answerReceived(stamp(scan), T, std::nullopt);
  }

  ScanPolicy policy_;
};

TEST_F(ScanSequenceTest, SendsTheFirstScanAtOnceAndTheNextAfterAnAnswerAndThePeriod) {
  auto scans = sequence(Kind::kNth);
  EXPECT_EQ(scans.next(kStart), Action::kSendScan);
  send(scans, kStart);
  EXPECT_EQ(scans.next(kStart + 0.5), Action::kWait);
  answer(scans, 1);
  EXPECT_EQ(scans.next(kStart + 0.05), Action::kWait);
  EXPECT_NEAR(scans.patience(kStart + 0.05), 0.05, 1e-9);
  EXPECT_EQ(scans.next(kStart + 0.1001), Action::kSendScan);
}

TEST_F(ScanSequenceTest, SendsTheNextScanWithoutAnAnswerAfterTheLimit) {
  auto scans = sequence(Kind::kFirst);
  send(scans, kStart);
  EXPECT_EQ(scans.next(kStart + 0.999), Action::kWait);
  EXPECT_TRUE(scans.isAwaitingAnswer());
  EXPECT_EQ(scans.next(kStart + 1.0), Action::kSendScan);
}

TEST_F(ScanSequenceTest, FollowsANodeThatAnswersAScanWhenTheNextComes) {
  auto scans = sequence(Kind::kNth, 3);
  double now = kStart;
  send(scans, now);
  for (int scan = 1; scan <= 3; ++scan) {
    now += policy_.answer_limit;
    ASSERT_EQ(scans.next(now), Action::kSendScan);
    send(scans, now);
    answer(scans, scan);
    EXPECT_FALSE(scans.isAwaitingAnswer());
  }
  EXPECT_EQ(scans.next(now), Action::kSubmit);
  EXPECT_EQ(scans.settling().latest()->scan, 3);
  EXPECT_EQ(scans.scansSent(), 4);
}

TEST_F(ScanSequenceTest, SendsOneMoreScanAfterTheLastThatCounts) {
  policy_.max_scans = 2;
  auto scans = sequence(Kind::kStable);
  send(scans, kStart);
  send(scans, kStart + 1.0);
  answer(scans, 1);
  ASSERT_EQ(scans.next(kStart + 1.2), Action::kSendScan);
  send(scans, kStart + 1.2);
  EXPECT_EQ(scans.next(kStart + 1.3), Action::kWait);
  answer(scans, 2);
  EXPECT_EQ(scans.next(kStart + 1.3), Action::kSubmit);
  EXPECT_EQ(scans.settling().latest()->scan, 2);
  EXPECT_EQ(scans.reason(kStart + 1.3), "not settled after 3 scans: the last answer");
}

TEST_F(ScanSequenceTest, SendsNoMoreOnceTheLastThatCountsIsAnswered) {
  policy_.max_scans = 2;
  auto scans = sequence(Kind::kStable);
  for (int scan = 1; scan <= 2; ++scan) {
    send(scans, kStart + scan);
    answer(scans, scan);
  }
  EXPECT_EQ(scans.next(kStart + 2.5), Action::kSubmit);
}

TEST_F(ScanSequenceTest, TheScanAfterTheLastDoesNotCount) {
  policy_.max_scans = 1;
  auto scans = sequence(Kind::kFirst);
  send(scans, kStart);
  send(scans, kStart + 1.0);
  answer(scans, 2);
  EXPECT_EQ(scans.next(kStart + 1.5), Action::kWait);
  EXPECT_EQ(scans.next(kStart + 2.0), Action::kGiveUp);
}

TEST_F(ScanSequenceTest, AtTheDeadlineTheLastAnswerIsSubmitted) {
  auto scans = sequence(Kind::kDeadline);
  send(scans, kStart);
  answer(scans, 1);
  send(scans, kStart + 8.0);
  answer(scans, 2);
  EXPECT_EQ(scans.next(kStart + 8.99), Action::kSendScan);
  EXPECT_EQ(scans.next(kStart + 9.0), Action::kSubmit);
  EXPECT_EQ(scans.settling().latest()->scan, 2);
  EXPECT_EQ(scans.reason(kStart + 9.0), "");
}

TEST_F(ScanSequenceTest, ASilentNodeIsGivenUpAtTheDeadlineWithTheReason) {
  auto scans = sequence(Kind::kFirst);
  for (double now = kStart; now < kStart + 9.0; now += 1.0) send(scans, now);
  EXPECT_EQ(scans.next(kStart + 9.0), Action::kGiveUp);
  EXPECT_EQ(scans.reason(kStart + 9.0), "the node said nothing to 9 scans");
}

TEST_F(ScanSequenceTest, MatchesStampsThatWentThroughMicroseconds) {
  auto scans = sequence(Kind::kFirst);
  scans.scanSent(kStart, kFirstStamp + 123);
  EXPECT_TRUE(scans.answerReceived(kFirstStamp, Transform::Identity(), std::nullopt));
}

TEST_F(ScanSequenceTest, RefusesAnswersToScansOfAnotherProblem) {
  auto scans = sequence(Kind::kFirst);
  send(scans, kStart);
  EXPECT_FALSE(scans.answerReceived(stamp(0), Transform::Identity(), std::nullopt));
  EXPECT_EQ(scans.next(kStart + 0.5), Action::kWait);
}

TEST_F(ScanSequenceTest, MatchesByArrivalWhereStampsSayNothing) {
  policy_.match_by_stamp = false;
  auto scans = sequence(Kind::kNth, 2);
  EXPECT_FALSE(scans.answerReceived(0, Transform::Identity(), std::nullopt));  // no scan is out
  send(scans, kStart);
  EXPECT_TRUE(scans.answerReceived(0, Transform::Identity(), std::nullopt));
  EXPECT_TRUE(scans.answerReceived(0, Transform::Identity(), std::nullopt));
  EXPECT_EQ(scans.settling().count(), 1);
  send(scans, kStart + 1.0);
  scans.answerReceived(0, Transform::Identity(), std::nullopt);
  EXPECT_EQ(scans.next(kStart + 1.0), Action::kSubmit);
}

}  // namespace
}  // namespace pcrb
