#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pcrb_core/error.hpp"
#include "server/problem_session.hpp"
#include "server/problem_session_fixture.hpp"

namespace pcrb {
namespace {

using namespace session_test;  // NOLINT(google-build-using-namespace)

TEST_F(ProblemSessionTest, RejectsAReplyToAnUnknownProblem) {
  startProblem("a");
  EXPECT_EQ(submit(validReply("b")), Response::UNKNOWN_PROBLEM);
  EXPECT_EQ(submit(validReply("")), Response::UNKNOWN_PROBLEM);
}

TEST_F(ProblemSessionTest, RejectsAReplyBeforeTheSourceIsHandedOut) {
  session_.announce("a", kStamp);
  EXPECT_EQ(submit(validReply()), Response::NOT_RUNNING);
}

TEST_F(ProblemSessionTest, RejectsASecondReplyAsDuplicateAlsoAfterTheEnd) {
  startProblem("a");
  EXPECT_EQ(submit(validReply()), Response::OK);
  EXPECT_EQ(submit(validReply()), Response::DUPLICATE);
  session_.waitReply(reply_);
  EXPECT_EQ(submit(validReply()), Response::DUPLICATE);
}

TEST_F(ProblemSessionTest, RejectsAReplyAfterTheLimitAsLate) {
  startProblem("a", kOver);
  EXPECT_EQ(submit(validReply()), Response::LATE);
  EXPECT_EQ(session_.waitReply(reply_), Wait::kLimit);
  EXPECT_EQ(submit(validReply()), Response::LATE);
}

TEST_F(ProblemSessionTest, RejectsNumbersThatAreNotFinite) {
  startProblem("a");
  Request request = validReply();
  request.pose.pose.position.y = std::nan("");
  EXPECT_EQ(submit(request), Response::NOT_FINITE);
  request = validReply();
  request.pose.pose.orientation.z = std::numeric_limits<double>::infinity();
  EXPECT_EQ(submit(request), Response::NOT_FINITE);
  request = validReply();
  request.pose.pose.position.x = 1e300;  // composing it with other transforms would overflow
  EXPECT_EQ(submit(request), Response::NOT_FINITE);
  request = validReply();
  request.covariance[35] = std::nan("");
  request.has_covariance = 1;
  EXPECT_EQ(submit(request), Response::NOT_FINITE);
  request.covariance[35] = 1e300;  // turning it into the target's frame would overflow
  EXPECT_EQ(submit(request), Response::NOT_FINITE);
  request.has_covariance = 0;
  EXPECT_EQ(submit(request), Response::OK);
}

TEST_F(ProblemSessionTest, RejectsSolverTimesThatCannotBeStored) {
  startProblem("a");
  Request request = validReply();
  request.solver_time = -1.0;
  EXPECT_EQ(submit(request), Response::NOT_FINITE);
  request.solver_time = std::numeric_limits<double>::infinity();
  request.status = Request::FAILED;
  EXPECT_EQ(submit(request), Response::NOT_FINITE);
  request.solver_time = 0.5;
  EXPECT_EQ(submit(request), Response::OK);
}

TEST_F(ProblemSessionTest, RejectsAStatusThatItDoesNotKnow) {
  startProblem("a");
  Request request = validReply();
  request.status = 3;
  EXPECT_EQ(submit(request), Response::NOT_FINITE);
}

TEST_F(ProblemSessionTest, RejectsQuaternionsThatAreNotUnitAndNormalisesTheRest) {
  startProblem("a");
  Request request = validReply();
  request.pose.pose.orientation.w = 1.0011;
  EXPECT_EQ(submit(request), Response::NOT_UNIT_QUATERNION);
  request.pose.pose.orientation.w = 0.0;
  EXPECT_EQ(submit(request), Response::NOT_UNIT_QUATERNION);
  request.pose.pose.orientation.w = 1.0009;
  EXPECT_EQ(submit(request), Response::OK);
  session_.waitReply(reply_);
  EXPECT_EQ(reply_.orientation.w(), 1.0);
}

}  // namespace
}  // namespace pcrb
