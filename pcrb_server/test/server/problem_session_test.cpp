#include "server/problem_session.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "pcrb_core/error.hpp"
#include "server/problem_session_fixture.hpp"

namespace pcrb {
namespace {

using namespace session_test;  // NOLINT(google-build-using-namespace)

TEST_F(ProblemSessionTest, TakesTheFirstValidReply) {
  startProblem("a");
  EXPECT_EQ(submit(validReply()), Response::OK);
  EXPECT_EQ(session_.waitReply(reply_), Wait::kDone);
  EXPECT_EQ(reply_.outcome, Outcome::kReplied);
  EXPECT_EQ(reply_.position.x(), 1.5);
  EXPECT_GE(reply_.runtime.value(), 0.0);
  EXPECT_FALSE(reply_.solver_time.has_value());
  EXPECT_EQ(reply_.rejected, 0u);
}

TEST_F(ProblemSessionTest, AReplyFromAnotherThreadEndsTheWait) {
  startProblem("a");
  std::thread client([this] { submit(validReply()); });
  EXPECT_EQ(session_.waitReply(reply_), Wait::kDone);
  client.join();
}

TEST_F(ProblemSessionTest, ARejectedReplyDoesNotEndTheProblem) {
  startProblem("a");
  Request request = validReply();
  request.pose.pose.orientation.w = 2.0;
  submit(request);
  EXPECT_EQ(submit(validReply()), Response::OK);
  EXPECT_EQ(session_.waitReply(reply_), Wait::kDone);
  EXPECT_EQ(reply_.rejected, 1u);
}

TEST_F(ProblemSessionTest, OnlyRejectedRepliesEndAsRejectedWithTheLastReason) {
  startProblem("a");
  Request request = validReply();
  request.pose.pose.orientation.w = 2.0;
  submit(request);
  session_.startClock(kOver);
  EXPECT_EQ(session_.waitReply(reply_), Wait::kLimit);
  EXPECT_EQ(reply_.outcome, Outcome::kRejected);
  EXPECT_NE(reply_.reason.find("norm"), std::string::npos);
}

TEST_F(ProblemSessionTest, RepliesToOtherProblemsDoNotCountAsRejectedOnes) {
  startProblem("a");
  submit(validReply("b"));
  session_.startClock(kOver);
  EXPECT_EQ(session_.waitReply(reply_), Wait::kLimit);
  EXPECT_EQ(reply_.outcome, Outcome::kTimedOut);
}

TEST_F(ProblemSessionTest, TheClientMayGiveUpAndSaysWhy) {
  startProblem("a");
  Request request = validReply();
  request.pose.pose.orientation.w = 0.0;  // no pose is looked at
  request.status = Request::FAILED;
  request.reason = "no features";
  EXPECT_EQ(submit(request), Response::OK);
  EXPECT_EQ(session_.waitReply(reply_), Wait::kDone);
  EXPECT_EQ(reply_.outcome, Outcome::kFailed);
  EXPECT_EQ(reply_.reason, "no features");
}

TEST_F(ProblemSessionTest, ReadyIsAcceptedForTheAnnouncedProblemOnly) {
  EXPECT_FALSE(ready("a"));
  session_.announce("a", kStamp);
  EXPECT_FALSE(ready("b"));
  EXPECT_TRUE(ready("a"));
  EXPECT_EQ(session_.waitReady(kLong), Wait::kDone);
  EXPECT_EQ(session_.client(), "/node");
  session_.startClock(kLong);
  EXPECT_FALSE(ready("a"));
}

TEST_F(ProblemSessionTest, AProblemBelongsToTheFirstCallerOfReady) {
  session_.announce("a", kStamp);
  EXPECT_TRUE(ready("a"));
  EXPECT_FALSE(ready("a", "/stranger"));
  EXPECT_TRUE(ready("a"));
  session_.startClock(kLong);
  Request wrong = validReply();
  wrong.pose.pose.orientation.w = 2.0;
  EXPECT_EQ(submit(validReply(), "/stranger"), Response::NOT_YOURS);
  EXPECT_EQ(submit(wrong, "/stranger"), Response::NOT_YOURS);
  EXPECT_EQ(submit(validReply(), ""), Response::NOT_YOURS);
  EXPECT_EQ(session_.foreignReplies(), 3u);
  session_.startClock(kOver);
  EXPECT_EQ(session_.waitReply(reply_), Wait::kLimit);
  EXPECT_EQ(reply_.outcome, Outcome::kTimedOut);  // not rejected: its client said nothing
  EXPECT_EQ(reply_.rejected, 0u);
}

TEST_F(ProblemSessionTest, AStrangerThatRepliesBeforeReadyDoesNotRejectTheProblem) {
  session_.announce("a", kStamp);
  EXPECT_EQ(submit(validReply(), "/stranger"), Response::NOT_RUNNING);
  EXPECT_EQ(session_.foreignReplies(), 1u);
  EXPECT_TRUE(ready("a"));
  session_.startClock(kOver);
  EXPECT_EQ(session_.waitReply(reply_), Wait::kLimit);
  EXPECT_EQ(reply_.outcome, Outcome::kTimedOut);
}

TEST_F(ProblemSessionTest, WithoutAHandshakeAnybodyMayReply) {
  ProblemSession open("map", noTransform, Handshake::kNone);
  open.announce("a", kStamp);
  open.startClock(kLong);
  Response response;
  open.submit("/anybody", validReply(), response);
  EXPECT_EQ(response.code, Response::OK);
}

TEST_F(ProblemSessionTest, CallersOfReadyMustHaveANodesName) {
  session_.announce("a", kStamp);
  for (const std::string& name : {std::string(), std::string("/"), std::string("node"),
                                  std::string("/evil node"), "/" + std::string(1000, 'a')}) {
    EXPECT_FALSE(ready("a", name)) << name;
  }
  EXPECT_FALSE(ready(std::string(1000000, 'b')));
  EXPECT_EQ(session_.client(), "");
  EXPECT_TRUE(ready("a", "/client_17_1700000000"));
}

TEST_F(ProblemSessionTest, SkippingEndsTheProblemAndNotTheNextOne) {
  startProblem("a");
  session_.skip();
  EXPECT_EQ(session_.waitReply(reply_), Wait::kSkipped);
  EXPECT_EQ(reply_.outcome, Outcome::kSkipped);
  startProblem("b", kOver);
  EXPECT_EQ(session_.waitReply(reply_), Wait::kLimit);
}

TEST_F(ProblemSessionTest, SkipsNothingWhereNoProblemWaitsForItsReply) {
  EXPECT_FALSE(session_.skip());
  startProblem("a");
  submit(validReply());
  EXPECT_FALSE(session_.skip());
  session_.waitReply(reply_);
  EXPECT_FALSE(session_.skip());
  startProblem("b");
  EXPECT_TRUE(session_.skip());
}

TEST_F(ProblemSessionTest, KeepsAReplyThatWasAcceptedBeforeTheStop) {
  startProblem("a");
  submit(validReply());
  session_.stop();
  EXPECT_EQ(session_.waitReply(reply_), Wait::kDone);
  EXPECT_EQ(reply_.position.x(), 1.5);
}

TEST_F(ProblemSessionTest, StoppingEndsEveryWait) {
  startProblem("a");
  session_.stop();
  EXPECT_EQ(session_.waitReply(reply_), Wait::kStopped);
  session_.announce("b", kStamp);
  EXPECT_EQ(session_.waitReady(kLong), Wait::kStopped);
}

TEST_F(ProblemSessionTest, TakesNothingAfterTheRun) {
  session_.endRun();
  EXPECT_EQ(submit(validReply()), Response::NOT_RUNNING);
  EXPECT_FALSE(ready("a"));
}

}  // namespace
}  // namespace pcrb
