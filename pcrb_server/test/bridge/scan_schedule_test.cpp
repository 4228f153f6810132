#include "bridge/scan_schedule.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

using Action = ScanSchedule::Action;
using Accept = AcceptanceRule::Kind;

constexpr double kStart = 100.0;                // s
constexpr std::int64_t kSpacing = 100'000'000;  // ns
constexpr std::int64_t kFirstStamp = 1'000'000'000'000;

class ScanScheduleTest : public testing::Test {
 protected:
  ScanSchedule sequence(Accept kind, int count = 2) {
    AcceptanceRule rule;
    rule.kind = kind;
    rule.count = count;
    return ScanSchedule(policy_, rule, std::nullopt, kStart, response_time_);
  }

  static std::int64_t stamp(int scan) { return kFirstStamp + scan * kSpacing; }

  static void send(ScanSchedule& sequence, double now) {
    sequence.scanSent(now, stamp(sequence.scansSent() + 1));
  }

  /// An answer of its own to each scan, so that nothing is stable.
  static bool answer(ScanSchedule& sequence, double now, int scan) {
    Transform T = Transform::Identity();
    T.translation().x() = scan;
    return sequence.answerReceived(now, stamp(scan), T, std::nullopt);
  }

  ScanPolicy policy_;
  ResponseTime response_time_;
};

TEST_F(ScanScheduleTest, SendsTheFirstScanAtOnceAndTheNextAfterAnAnswerAndThePeriod) {
  auto scans = sequence(Accept::kNth);
  EXPECT_EQ(scans.next(kStart), Action::kSendScan);
  send(scans, kStart);
  EXPECT_EQ(scans.next(kStart + 0.5), Action::kWait);
  answer(scans, kStart + 0.01, 1);
  EXPECT_EQ(scans.next(kStart + 0.05), Action::kWait);
  EXPECT_NEAR(scans.timeToNext(kStart + 0.05), 0.05, 1e-9);
  EXPECT_EQ(scans.next(kStart + 0.1001), Action::kSendScan);
}

TEST_F(ScanScheduleTest, KeepsTheRateOfASensorWhetherTheNodeAnswersOrNot) {
  policy_.keeps_rate = true;
  auto scans = sequence(Accept::kNth, 3);
  send(scans, kStart);
  EXPECT_EQ(scans.next(kStart + 0.05), Action::kWait);
  EXPECT_EQ(scans.next(kStart + 0.1001), Action::kSendScan);
  send(scans, kStart + 0.1001);
  EXPECT_TRUE(answer(scans, kStart + 0.15, 1));
  EXPECT_EQ(scans.next(kStart + 0.16), Action::kWait);
  EXPECT_EQ(scans.scans()[0].answered, kStart + 0.15);
  EXPECT_EQ(scans.scans()[1].answered, 0.0);
}

TEST_F(ScanScheduleTest, SendsTheNextScanWithoutAnAnswerAfterTheLimit) {
  auto scans = sequence(Accept::kFirst);
  send(scans, kStart);
  EXPECT_EQ(scans.next(kStart + 0.999), Action::kWait);
  EXPECT_EQ(scans.next(kStart + 1.0), Action::kSendScan);
}

TEST_F(ScanScheduleTest, FollowsANodeThatAnswersAScanWhenTheNextComes) {
  auto scans = sequence(Accept::kNth, 3);
  double now = kStart;
  send(scans, now);
  for (int scan = 1; scan <= 3; ++scan) {
    now += policy_.answer_limit;
    ASSERT_EQ(scans.next(now), Action::kSendScan);
    send(scans, now);
    answer(scans, now, scan);
  }
  EXPECT_EQ(scans.next(now), Action::kSubmit);
  EXPECT_EQ(scans.convergence().latest()->scan, 3);
  EXPECT_EQ(scans.scansSent(), 4);
}

TEST_F(ScanScheduleTest, SendsOneMoreScanAfterTheLastThatCounts) {
  policy_.max_scans = 2;
  auto scans = sequence(Accept::kStable);
  send(scans, kStart);
  send(scans, kStart + 1.0);
  answer(scans, kStart + 1.01, 1);
  ASSERT_EQ(scans.next(kStart + 1.2), Action::kSendScan);
  send(scans, kStart + 1.2);
  EXPECT_EQ(scans.next(kStart + 1.3), Action::kWait);
  answer(scans, kStart + 1.3, 2);
  EXPECT_EQ(scans.next(kStart + 1.3), Action::kSubmit);
  EXPECT_EQ(scans.convergence().latest()->scan, 2);
  EXPECT_EQ(scans.reason(kStart + 1.3), "not settled after 3 scans: the last answer");
}

TEST_F(ScanScheduleTest, SendsNoMoreOnceTheLastThatCountsIsAnswered) {
  policy_.max_scans = 2;
  auto scans = sequence(Accept::kStable);
  for (int scan = 1; scan <= 2; ++scan) {
    send(scans, kStart + scan);
    answer(scans, kStart + scan, scan);
  }
  EXPECT_EQ(scans.next(kStart + 2.5), Action::kSubmit);
}

TEST_F(ScanScheduleTest, TheScanAfterTheLastDoesNotCount) {
  policy_.max_scans = 1;
  auto scans = sequence(Accept::kFirst);
  send(scans, kStart);
  send(scans, kStart + 1.0);
  answer(scans, kStart + 1.01, 2);
  EXPECT_EQ(scans.next(kStart + 1.5), Action::kWait);
  EXPECT_EQ(scans.next(kStart + 2.0), Action::kGiveUp);
}

TEST_F(ScanScheduleTest, AtTheDeadlineTheLastAnswerIsSubmitted) {
  auto scans = sequence(Accept::kDeadline);
  send(scans, kStart);
  answer(scans, kStart + 0.01, 1);
  send(scans, kStart + 8.0);
  answer(scans, kStart + 8.01, 2);
  EXPECT_EQ(scans.next(kStart + 8.99), Action::kSendScan);
  EXPECT_EQ(scans.next(kStart + 9.0), Action::kSubmit);
  EXPECT_EQ(scans.convergence().latest()->scan, 2);
  EXPECT_EQ(scans.reason(kStart + 9.0), "");
}

TEST_F(ScanScheduleTest, ASilentNodeIsGivenUpAtTheDeadlineWithTheReason) {
  auto scans = sequence(Accept::kFirst);
  for (double now = kStart; now < kStart + 9.0; now += 1.0) send(scans, now);
  EXPECT_EQ(scans.next(kStart + 9.0), Action::kGiveUp);
  EXPECT_EQ(scans.reason(kStart + 9.0), "the node said nothing to 9 scans");
}

TEST_F(ScanScheduleTest, ANodeThatFallsSilentIsSaidToHaveDoneSo) {
  auto scans = sequence(Accept::kStable);
  for (double now = kStart; now < kStart + 9.0; now += 1.0) send(scans, now);
  answer(scans, kStart + 8.5, 1);
  EXPECT_EQ(scans.next(kStart + 9.0), Action::kSubmit);
  EXPECT_EQ(scans.reason(kStart + 9.0),
            "not settled after 9 scans, 1 of them answered, at the deadline: the last answer");
}

TEST_F(ScanScheduleTest, MatchesStampsThatWentThroughMicroseconds) {
  auto scans = sequence(Accept::kFirst);
  scans.scanSent(kStart, kFirstStamp + 123);
  EXPECT_TRUE(scans.answerReceived(kStart, kFirstStamp, Transform::Identity(), std::nullopt));
}

TEST_F(ScanScheduleTest, RefusesAnswersToScansOfAnotherProblem) {
  auto scans = sequence(Accept::kFirst);
  send(scans, kStart);
  EXPECT_FALSE(scans.answerReceived(kStart, stamp(0), Transform::Identity(), std::nullopt));
  EXPECT_EQ(scans.next(kStart + 0.5), Action::kWait);
}

TEST_F(ScanScheduleTest, MatchesByArrivalWhereStampsSayNothing) {
  policy_.match_by_stamp = false;
  auto scans = sequence(Accept::kNth, 2);
  EXPECT_FALSE(
      scans.answerReceived(kStart, 0, Transform::Identity(), std::nullopt));  // no scan is out
  send(scans, kStart);
  EXPECT_TRUE(scans.answerReceived(kStart, 0, Transform::Identity(), std::nullopt));
  EXPECT_TRUE(scans.answerReceived(kStart, 0, Transform::Identity(), std::nullopt));
  EXPECT_EQ(scans.convergence().count(), 1);
  send(scans, kStart + 1.0);
  scans.answerReceived(kStart, 0, Transform::Identity(), std::nullopt);
  EXPECT_EQ(scans.next(kStart + 1.0), Action::kSubmit);
}

TEST_F(ScanScheduleTest, ANodeFinishesWhenItHasAnsweredTheLastScanNotWithALateAnswerToAnOlderOne) {
  auto scans = sequence(Accept::kFirst);
  send(scans, kStart);
  send(scans, kStart + 1.0);
  answer(scans, kStart + 1.5, 1);
  ASSERT_EQ(scans.next(kStart + 1.5), Action::kSubmit);
  EXPECT_NEAR(scans.timeToFinish(kStart + 1.5), 3.0, 1e-9);
  answer(scans, kStart + 3.0, 2);
  EXPECT_EQ(scans.timeToFinish(kStart + 3.0), 0.0);
}

TEST_F(ScanScheduleTest, ANodeMayFinishAfterTheDeadline) {
  auto scans = sequence(Accept::kDeadline);
  send(scans, kStart);
  answer(scans, kStart + 5.0, 1);
  send(scans, kStart + 5.1);
  ASSERT_EQ(scans.next(kStart + 9.0), Action::kSubmit);
  EXPECT_NEAR(scans.timeToFinish(kStart + 9.0), 6.1, 1e-9);
}

TEST_F(ScanScheduleTest, ANodeThatNeverAnsweredHasAsLongAgainAsItWasSentScansFor) {
  auto scans = sequence(Accept::kFirst);
  for (double now = kStart; now < kStart + 9.0; now += 1.0) send(scans, now);
  EXPECT_NEAR(scans.timeToFinish(kStart + 9.0), 7.0, 1e-9);
}

TEST_F(ScanScheduleTest, ANodeThatHeldItsLastScanInVainIsNotWaitedForAgain) {
  auto first = sequence(Accept::kFirst);
  send(first, kStart);
  send(first, kStart + 1.0);
  answer(first, kStart + 1.1, 1);
  EXPECT_FALSE(first.responseTimeAtEnd(kStart + 1.2).holdsLastScan());
  response_time_ = first.responseTimeAtEnd(kStart + 1.1 + first.timeToFinish(kStart + 1.1));
  ASSERT_TRUE(response_time_.holdsLastScan());

  auto second = sequence(Accept::kNth);
  send(second, kStart);
  send(second, kStart + 3.0);
  answer(second, kStart + 3.1, 1);
  EXPECT_EQ(second.timeToFinish(kStart + 3.1), 0.0);
  EXPECT_NEAR(second.responseTimeAtEnd(kStart + 3.1).latest(), 0.1, 1e-9);
  answer(second, kStart + 3.2, 2);  // no such node after all
  EXPECT_FALSE(second.responseTimeAtEnd(kStart + 3.2).holdsLastScan());
}

TEST_F(ScanScheduleTest, ASilentNodeHoldsMoreThanItsLastScan) {
  response_time_.setHoldsLastScan(true);
  auto scans = sequence(Accept::kFirst);
  send(scans, kStart);
  EXPECT_GT(scans.timeToFinish(kStart + 0.5), 0.0);
}

TEST_F(ScanScheduleTest, ASlowNodeIsGivenTheTimeThatItNeedsBeforeTheNextScan) {
  response_time_.add(1.5);
  auto scans = sequence(Accept::kNth);
  send(scans, kStart);
  EXPECT_EQ(scans.next(kStart + 2.99), Action::kWait);
  EXPECT_EQ(scans.next(kStart + 3.0), Action::kSendScan);
}

TEST_F(ScanScheduleTest, AnEchoOfTheInitialPoseIsNoEndOfWork) {
  ScanSchedule scans(policy_, {}, Transform::Identity(), kStart);
  send(scans, kStart);
  scans.answerReceived(kStart + 0.1, stamp(1), Transform::Identity(), std::nullopt);
  EXPECT_GT(scans.timeToFinish(kStart + 0.1), 0.0);
  EXPECT_FALSE(scans.responseTimeAtEnd(kStart + 0.1).isKnown());
}

TEST_F(ScanScheduleTest, AfterAnEchoTheNextScanWaitsForTheAnswerAsLongAsOneTakes) {
  ScanSchedule unknown(policy_, {}, Transform::Identity(), kStart);
  send(unknown, kStart);
  unknown.answerReceived(kStart + 0.01, stamp(1), Transform::Identity(), std::nullopt);
  EXPECT_EQ(unknown.next(kStart + 0.999), Action::kWait);
  EXPECT_EQ(unknown.next(kStart + 1.0), Action::kSendScan);
  answer(unknown, kStart + 0.3, 1);
  EXPECT_EQ(unknown.next(kStart + 0.3), Action::kSendScan);
  response_time_.add(0.2);
  ScanSchedule known(policy_, {}, Transform::Identity(), kStart, response_time_);
  send(known, kStart);
  known.answerReceived(kStart + 0.01, stamp(1), Transform::Identity(), std::nullopt);
  EXPECT_EQ(known.next(kStart + 0.399), Action::kWait);
  EXPECT_EQ(known.next(kStart + 0.401), Action::kSendScan);
}

TEST_F(ScanScheduleTest, WithoutStampsAnAnswerEndsTheWorkOnTheOldestScan) {
  policy_.match_by_stamp = false;
  auto scans = sequence(Accept::kFirst);
  send(scans, kStart);
  send(scans, kStart + 1.0);
  scans.answerReceived(kStart + 1.5, 0, Transform::Identity(), std::nullopt);
  EXPECT_GT(scans.timeToFinish(kStart + 1.5), 0.0);
  scans.answerReceived(kStart + 3.0, 0, Transform::Identity(), std::nullopt);
  EXPECT_EQ(scans.timeToFinish(kStart + 3.0), 0.0);
}

TEST(ResponseTime, TheSlowestAnswerIsForgottenAfterTenOthers) {
  ResponseTime pace;
  pace.add(15.0);
  for (int i = 0; i < 9; ++i) pace.add(0.1);
  EXPECT_EQ(pace.slowest(), 15.0);
  EXPECT_EQ(pace.latest(), 0.1);
  pace.add(0.1);
  EXPECT_EQ(pace.slowest(), 0.1);
}

}  // namespace
}  // namespace pcrb
