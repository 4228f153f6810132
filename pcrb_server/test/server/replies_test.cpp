#include "server/replies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pcrb {
namespace {

using Request = pcrb_msgs::SubmitPose::Request;
using Response = pcrb_msgs::SubmitPose::Response;

Request validRequest() {
  Request request;
  request.pose.pose.position.x = 1.5;
  request.pose.pose.orientation.w = 1.0;
  request.solver_time = std::nan("");
  return request;
}

TEST(Replies, TakeOverWhatARequestSays) {
  Request request = validRequest();
  request.has_covariance = 1;
  request.covariance[35] = 0.25;
  request.scans_used = 4;
  request.cpu_time = 0.5;
  request.peak_memory = 4096;
  request.reason = "converged";
  Submission submission;
  ASSERT_FALSE(readSubmission(request, submission).has_value());
  EXPECT_EQ(submission.status, Submission::Status::kPose);
  EXPECT_EQ(submission.position, Eigen::Vector3d(1.5, 0.0, 0.0));
  EXPECT_EQ(submission.orientation.w(), 1.0);
  EXPECT_EQ(submission.covariance.value().back(), 0.25);
  EXPECT_FALSE(submission.solver_time.has_value());
  EXPECT_EQ(submission.scans_used, 4u);
  EXPECT_EQ(submission.cpu_time, 0.5);
  EXPECT_EQ(submission.peak_memory, 4096u);
  EXPECT_EQ(submission.reason, "converged");
}

TEST(Replies, AreCutWhereTheirReasonIsLong) {
  Request request = validRequest();
  request.status = Request::FAILED;
  request.reason.assign(100000, 'x');
  Submission submission;
  ASSERT_FALSE(readSubmission(request, submission).has_value());
  EXPECT_EQ(submission.reason.size(), 4096u);
}

TEST(Replies, DoNotLookAtACovarianceThatIsNotGiven) {
  Request request = validRequest();
  request.covariance[0] = std::nan("");
  Submission submission;
  EXPECT_FALSE(readSubmission(request, submission).has_value());
  EXPECT_FALSE(submission.covariance.has_value());
}

TEST(Replies, AreRejectedWithTheCodeOfTheirDefect) {
  Submission submission;
  Request request = validRequest();
  request.pose.pose.orientation.w = 2.0;
  EXPECT_EQ(readSubmission(request, submission)->code, Response::NOT_UNIT_QUATERNION);
  request.pose.pose.orientation.w = std::numeric_limits<double>::infinity();
  EXPECT_EQ(readSubmission(request, submission)->code, Response::NOT_FINITE);
  request = validRequest();
  request.status = 3;
  EXPECT_EQ(readSubmission(request, submission)->message, "found status 3, expected 0, 1 or 2");
}

}  // namespace
}  // namespace pcrb
