#include "server/problem_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <thread>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

using Request = pcrb_msgs::SubmitPose::Request;
using Response = pcrb_msgs::SubmitPose::Response;
using Wait = ProblemSession::Wait;

constexpr std::chrono::duration<double> kLong(60.0);
constexpr std::chrono::duration<double> kOver(0.0);  ///< a limit that has passed
const ros::Time kStamp(1000, 5);

Request validReply(const std::string& id = "a") {
  Request request;
  request.problem_id = id;
  request.pose.header.frame_id = "map";
  request.pose.pose.position.x = 1.5;
  request.pose.pose.orientation.w = 1.0;
  request.solver_time = std::nan("");
  return request;
}

std::optional<Transform> noTransform(const std::string&, const ros::Time&) { return std::nullopt; }

class ProblemSessionTest : public testing::Test {
 protected:
  int submit(const Request& request) {
    Response response;
    session_.submit(request, response);
    EXPECT_EQ(response.accepted != 0, response.code == Response::OK);
    EXPECT_EQ(response.message.empty(), response.code == Response::OK) << response.message;
    return response.code;
  }

  bool ready(const std::string& id) {
    pcrb_msgs::Ready::Request request;
    pcrb_msgs::Ready::Response response;
    request.problem_id = id;
    session_.ready("/node", request, response);
    return response.accepted != 0;
  }

  void startProblem(const std::string& id, std::chrono::duration<double> limit = kLong) {
    session_.announce(id, kStamp);
    session_.startClock(limit);
  }

  ProblemSession session_{"map", noTransform};
  Reply reply_;
};

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

TEST_F(ProblemSessionTest, RejectsAFrameThatTfDoesNotConnect) {
  startProblem("a");
  Request request = validReply();
  request.pose.header.frame_id = "elsewhere";
  EXPECT_EQ(submit(request), Response::NO_TRANSFORM);
  request.pose.header.frame_id = "/map";
  EXPECT_EQ(submit(request), Response::OK);
}

TEST(ProblemSession, ComposesARepliesPoseWithTheTransformOfItsFrame) {
  ros::Time asked;
  ProblemSession session("map", [&](const std::string& frame, const ros::Time& stamp) {
    EXPECT_EQ(frame, "odom");
    asked = stamp;
    const Eigen::Quaterniond quarter(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
    return std::make_optional(makeTransform({10, 0, 0}, quarter));
  });
  session.announce("a", kStamp);
  session.startClock(kLong);
  Request request = validReply();
  request.pose.header.frame_id = "odom";
  Response response;
  session.submit(request, response);
  EXPECT_EQ(response.code, Response::OK);
  EXPECT_EQ(asked, kStamp);
  Reply reply;
  session.waitReply(reply);
  EXPECT_LT((reply.position - Eigen::Vector3d(10, 1.5, 0)).norm(), 1e-12);
  EXPECT_NEAR(reply.orientation.z(), std::sqrt(0.5), 1e-12);
}

/// Hands problem `a` out, whose reply comes in `odom`; tf says what `T_map_odom` is.
class ProblemSessionWithTf : public testing::Test {
 protected:
  void SetUp() override {
    session_.announce("a", kStamp);
    session_.startClock(kLong);
    request_.pose.header.frame_id = "odom";
  }

  Transform T_map_odom_ = Transform::Identity();
  ProblemSession session_{"map", [this](const std::string&, const ros::Time&) {
                            if (!T_map_odom_.translation().allFinite()) throw Error("not finite");
                            return std::make_optional(T_map_odom_);
                          }};
  Request request_ = validReply();
  Response response_;
  Reply reply_;
};

TEST_F(ProblemSessionWithTf, ALookUpThatThrowsDoesNotKeepTheProblemFromEnding) {
  T_map_odom_.translation().x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(session_.submit(request_, response_), Error);
  session_.startClock(kOver);
  auto wait = std::async(std::launch::async, [this] { return session_.waitReply(reply_); });
  wait.wait_for(std::chrono::seconds(10));
  session_.stop();  // one that goes on for ever
  EXPECT_EQ(wait.get(), Wait::kLimit);
  EXPECT_EQ(reply_.outcome, Outcome::kTimedOut);
}

TEST_F(ProblemSessionWithTf, RejectsAPoseThatTfMakesHuge) {
  T_map_odom_.translation().x() = 1e300;
  session_.submit(request_, response_);
  EXPECT_EQ(response_.code, Response::NOT_FINITE);
  T_map_odom_.translation().x() = 1e99;
  session_.submit(request_, response_);
  EXPECT_EQ(response_.code, Response::OK);
}

TEST_F(ProblemSessionWithTf, TurnsTheCovarianceWithThePose) {
  using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  T_map_odom_ = makeTransform({10, 0, 0}, Eigen::Quaterniond(turn));
  request_.has_covariance = 1;
  Matrix6 in_odom;
  for (int i = 0; i < 36; ++i) in_odom(i / 6, i % 6) = 1.0 + i * i % 17;
  std::copy_n(in_odom.data(), 36, request_.covariance.begin());
  session_.submit(request_, response_);
  ASSERT_EQ(response_.code, Response::OK);
  session_.waitReply(reply_);
  const Matrix6 in_map = Eigen::Map<const Matrix6>(reply_.covariance->data());
  for (const int row : {0, 3}) {
    for (const int column : {0, 3}) {
      const Eigen::Matrix3d block = in_odom.block<3, 3>(row, column);
      const Eigen::Matrix3d expected =
          turn.toRotationMatrix() * block * turn.toRotationMatrix().transpose();
      EXPECT_LT((in_map.block<3, 3>(row, column) - expected).norm(), 1e-12);
    }
  }
}

TEST(ProblemSession, WaitsForTheTransformOfAReplyThatCameInTime) {
  std::promise<void> entered;
  std::promise<void> release;
  ProblemSession session("map", [&](const std::string&, const ros::Time&) {
    entered.set_value();
    release.get_future().wait();
    return std::make_optional(Transform::Identity());
  });
  session.announce("a", kStamp);
  session.startClock(kLong);
  Request request = validReply();
  request.pose.header.frame_id = "odom";
  Response response;
  std::thread client([&] { session.submit(request, response); });
  entered.get_future().wait();
  session.startClock(kOver);
  Reply reply;
  auto wait = std::async(std::launch::async, [&] { return session.waitReply(reply); });
  EXPECT_EQ(wait.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  release.set_value();
  EXPECT_EQ(wait.get(), Wait::kDone);
  client.join();
  EXPECT_EQ(response.code, Response::OK);
}

}  // namespace
}  // namespace pcrb
