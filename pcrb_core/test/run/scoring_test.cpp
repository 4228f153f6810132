#include "pcrb_core/run/scoring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "run/run_fixture.hpp"

namespace pcrb {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Submission poseAt(const Eigen::Vector3d& position) {
  Submission submission;
  submission.position = position;
  return submission;
}

TEST(Submission, IsTakenWithFiniteNumbersAndANearlyUnitQuaternion) {
  Submission submission = poseAt({1.0, 2.0, 3.0});
  submission.orientation.coeffs() *= 1.0009;
  submission.solver_time = 0.0;
  EXPECT_FALSE(checkSubmission(submission).has_value());
  EXPECT_NEAR(makeReply(submission, std::nullopt).orientation.norm(), 1.0, 1e-15);
}

TEST(Submission, IsRefusedForNumbersThatCannotBeScored) {
  for (const double number : {kNaN, kInfinity, 1e300}) {
    EXPECT_EQ(checkSubmission(poseAt({0.0, number, 0.0}))->kind, Defect::Kind::kNotFinite);
    Submission submission;
    submission.orientation.z() = number;
    EXPECT_EQ(checkSubmission(submission)->kind, Defect::Kind::kNotFinite);
    submission = Submission();
    submission.covariance.emplace();
    submission.covariance->back() = number;
    EXPECT_EQ(checkSubmission(submission)->kind, Defect::Kind::kNotFinite);
  }
}

TEST(Submission, IsRefusedForAQuaternionThatIsNoRotation) {
  for (const double norm : {0.0, 0.998, 1.0011, 2.0}) {
    Submission submission;
    submission.orientation.w() = norm;
    const auto defect = checkSubmission(submission);
    ASSERT_TRUE(defect.has_value()) << norm;
    EXPECT_EQ(defect->kind, Defect::Kind::kNotUnitQuaternion);
    submission.status = Submission::Status::kFailed;  // no pose is looked at
    EXPECT_FALSE(checkSubmission(submission).has_value());
  }
}

TEST(Submission, IsRefusedForTimesThatCannotBeStored) {
  for (const double time : {-1.0, kInfinity, kNaN}) {
    Submission submission;
    submission.status = Submission::Status::kFailed;
    submission.cpu_time = time;
    EXPECT_TRUE(checkSubmission(submission).has_value()) << time;
    submission.cpu_time = 0.0;
    submission.solver_time = time;
    EXPECT_TRUE(checkSubmission(submission).has_value()) << time;
  }
}

TEST(Submission, MayNotBecomeHugeInTheTargetsFrame) {
  Transform T = Transform::Identity();
  T.translation().x() = 1e99;
  EXPECT_FALSE(checkPlaced(poseAt({1.0, 0.0, 0.0}), T).has_value());
  T.translation().x() = 1e101;
  EXPECT_TRUE(checkPlaced(poseAt({1.0, 0.0, 0.0}), T).has_value());
}

TEST(Submission, WithoutAPoseIsAReplyWithAReason) {
  Submission submission;
  submission.status = Submission::Status::kFailed;
  EXPECT_EQ(makeReply(submission, std::nullopt).reason, "the client gave no reason");
  submission.reason = "no features";
  submission.solver_time = 2.0;
  const Reply reply = makeReply(submission, std::nullopt);
  EXPECT_EQ(reply.outcome, Outcome::kFailed);
  EXPECT_EQ(reply.reason, "no features");
  EXPECT_EQ(reply.solver_time, 2.0);
  EXPECT_FALSE(reply.scans_used.has_value());
}

TEST(Submission, InAnotherFrameIsTurnedIntoTheTargets) {
  const Transform T =
      makeTransform({10.0, 0.0, 0.0},
                    Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ())));
  const Reply reply = makeReply(poseAt({1.0, 0.0, 0.0}), T);
  EXPECT_LT((reply.position - Eigen::Vector3d(10.0, 1.0, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(reply.orientation.z(), std::sqrt(0.5), 1e-12);
}

/// Scores replies to the first problem of the hall, whose source is moved by 0.1 m along x.
class ScoringTest : public RunFixture {
 protected:
  PosedProblem pose(const PresentationOptions& presentation) {
    poser_.emplace(selection_.root, presentation, secret_);
    return poser_->pose(plan_.problems.at(0));
  }

  static Reply replyOf(const Transform& T) {
    Submission submission = poseAt(T.translation());
    submission.orientation = Eigen::Quaterniond(T.linear());
    return makeReply(submission, std::nullopt);
  }

  const RunPlan plan_ = makeRunPlan(selection_);
  std::optional<ProblemPoser> poser_;
};

TEST_F(ScoringTest, GivesTheIdealReplyNoErrorInBothPresentations) {
  for (const auto kind : {PresentationKind::kRegistration, PresentationKind::kLocalization}) {
    const PosedProblem posed = pose({kind, false});
    const Result result = score(posed, replyOf(posed.presentation.ideal()));
    EXPECT_EQ(result.outcome, Outcome::kReplied);
    EXPECT_LT(result.error, 1e-12);
    EXPECT_NEAR(result.initial_misalignment, posed.initial.error, 0.0);
  }
}

TEST_F(ScoringTest, GivesTheGuessTheInitialMisalignmentInBothPresentations) {
  for (const auto kind : {PresentationKind::kRegistration, PresentationKind::kLocalization}) {
    const PosedProblem posed = pose({kind, false});
    const Result result = score(posed, replyOf(posed.presentation.guess));
    EXPECT_NEAR(result.error, result.initial_misalignment, 1e-12);
    EXPECT_NEAR(result.translation_error, 0.1, 1e-12);
  }
}

TEST_F(ScoringTest, GivesEquivalentRepliesTheSameScoreWithAndWithoutAnAudit) {
  const Transform off =
      makeTransform({0.02, -0.01, 0.03}, Eigen::Quaterniond(0.999, 0.02, 0, 0.01));
  for (const auto kind : {PresentationKind::kRegistration, PresentationKind::kLocalization}) {
    const PosedProblem plain = pose({kind, false, false});
    const Presentation without = plain.presentation;
    const PosedProblem audited = pose({kind, false, true});
    const Transform A = audited.presentation.target_applied;
    const Result expected = score(plain, replyOf(without.ideal() * off));
    EXPECT_LT(score(audited, replyOf(audited.presentation.ideal())).error, 1e-12);
    EXPECT_NEAR(score(audited, replyOf(audited.presentation.guess)).error,
                expected.initial_misalignment, 1e-12);
    if (kind == PresentationKind::kLocalization) {
      EXPECT_NEAR(score(audited, replyOf(A * without.ideal() * off)).error, expected.error, 1e-12);
    }
  }
}

TEST_F(ScoringTest, AnAuditMovesTheTargetSecretlyAndItsGuessWithIt) {
  const PosedProblem audited = pose({PresentationKind::kRegistration, false, true});
  const Transform A = audited.presentation.target_applied;
  EXPECT_GT(rotationAngle(A.linear()), 0.01);
  EXPECT_GT(A.translation().norm(), 0.1);
  EXPECT_TRUE(audited.presentation.applied.isApprox(A * audited.P, 1e-12));
  secret_ = Secret::draw();
  const PosedProblem other = pose({PresentationKind::kRegistration, false, true});
  EXPECT_FALSE(other.presentation.target_applied.isApprox(A, 1e-3));
  const PosedProblem upright = pose({PresentationKind::kLocalization, false, true});
  const Eigen::Matrix3d R = upright.presentation.target_applied.linear();
  EXPECT_TRUE(R.col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));  // z stays up
  EXPECT_GT(rotationAngle(R), 1e-6);
}

TEST_F(ScoringTest, AnAuditPublishesAPartOfTheCloudInAnOrderOfEachProblem) {
  const PosedProblem first = pose({PresentationKind::kRegistration, false, true});
  const PointCloud part = auditedSource(first, secret_);
  EXPECT_EQ(part.size(), 48u);  // of 50
  EXPECT_EQ(auditedTarget(first, secret_).size(), 48u);
  const PosedProblem second = poser_->pose(plan_.problems.at(2));  // of the same pair
  ASSERT_EQ(second.source, first.source);
  const PointCloud again = auditedSource(second, secret_);
  std::size_t same = 0;
  for (std::size_t i = 0; i < part.size(); ++i) same += part.points[i] == again.points[i] ? 1 : 0;
  EXPECT_LT(same, 10u);
}

TEST_F(ScoringTest, GivesAProblemWithoutAPoseTheInitialMisalignment) {
  const PosedProblem posed = pose({PresentationKind::kLocalization, false});
  Reply reply;
  reply.outcome = Outcome::kRejected;
  reply.reason = "nothing but NaN";
  reply.rejected = 3;
  const Result result = score(posed, reply);
  EXPECT_EQ(result.error, result.initial_misalignment);
  EXPECT_EQ(result.replies_rejected, 3u);
  EXPECT_EQ(result.reason, "nothing but NaN");
  EXPECT_FALSE(result.position.has_value());
  EXPECT_TRUE(scoredPose(posed, result).isApprox(posed.presentation.guess));
}

TEST_F(ScoringTest, KeepsWhatTheRowAndTheReplySay) {
  const PosedProblem posed = pose({});
  Reply reply = replyOf(Transform(Eigen::Translation3d(1.0, 2.0, 3.0)));
  reply.runtime = 0.5;
  const Result result = score(posed, reply);
  EXPECT_EQ(result.key, plan_.problems[0].key);
  EXPECT_EQ(result.source, "a.pcd");
  EXPECT_EQ(result.overlap, 0.5);
  EXPECT_EQ(result.runtime, 0.5);
  EXPECT_EQ(*result.position, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_TRUE(scoredPose(posed, result).translation().isApprox(Eigen::Vector3d(1.0, 2.0, 3.0)));
  EXPECT_GT(result.finished, 1e9);
}

TEST_F(ScoringTest, ScoresTheAnswerToEveryScanLikeTheReply) {
  const PosedProblem posed = pose({PresentationKind::kLocalization, false});
  Submission submission = poseAt(posed.presentation.guess.translation());
  submission.orientation = Eigen::Quaterniond(posed.presentation.guess.linear());
  submission.scans.resize(2);
  submission.scans[0].scan = 1;
  submission.scans[1].scan = 2;
  submission.scans[1].answered = 0.5;
  submission.scans[1].position = submission.position;
  submission.scans[1].orientation = submission.orientation;
  const Result result = score(posed, makeReply(submission, std::nullopt));
  ASSERT_EQ(result.scans.size(), 2u);
  EXPECT_FALSE(result.scans[0].error.has_value());
  EXPECT_EQ(result.scans[1].error, result.error);
}

TEST(Submission, IsRefusedForScansThatCannotBeStored) {
  Submission submission;
  submission.scans.resize(2);
  submission.scans[0].scan = submission.scans[1].scan = 1;
  EXPECT_NE(checkSubmission(submission)->message.find("scans[1]"), std::string::npos);
  submission.scans[1].scan = 2;
  EXPECT_FALSE(checkSubmission(submission).has_value());
  submission.scans[1].position = Eigen::Vector3d(kNaN, 0.0, 0.0);
  submission.scans[1].orientation = Eigen::Quaterniond::Identity();
  EXPECT_EQ(checkSubmission(submission)->kind, Defect::Kind::kNotFinite);
}

}  // namespace
}  // namespace pcrb
