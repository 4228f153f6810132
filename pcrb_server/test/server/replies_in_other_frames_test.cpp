#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <thread>

#include "pcrb_core/error.hpp"
#include "server/problem_session.hpp"
#include "server/problem_session_fixture.hpp"

namespace pcrb {
namespace {

using namespace session_test;  // NOLINT(google-build-using-namespace)

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
  begin(session, "a", kLong);
  Request request = validReply();
  request.pose.header.frame_id = "odom";
  Response response;
  session.submit("/node", request, response);
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
    begin(session_, "a", kLong);
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
  EXPECT_THROW(session_.submit("/node", request_, response_), Error);
  session_.startClock(kOver);
  auto wait = std::async(std::launch::async, [this] { return session_.waitReply(reply_); });
  wait.wait_for(std::chrono::seconds(10));
  session_.stop();  // one that goes on for ever
  EXPECT_EQ(wait.get(), Wait::kLimit);
  EXPECT_EQ(reply_.outcome, Outcome::kTimedOut);
}

TEST_F(ProblemSessionWithTf, RejectsAPoseThatTfMakesHuge) {
  T_map_odom_.translation().x() = 1e300;
  session_.submit("/node", request_, response_);
  EXPECT_EQ(response_.code, Response::NOT_FINITE);
  T_map_odom_.translation().x() = 1e99;
  session_.submit("/node", request_, response_);
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
  session_.submit("/node", request_, response_);
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
  begin(session, "a", kLong);
  Request request = validReply();
  request.pose.header.frame_id = "odom";
  Response response;
  std::thread client([&] { session.submit("/node", request, response); });
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
