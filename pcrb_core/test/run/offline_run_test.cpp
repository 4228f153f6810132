#include "pcrb_core/run/offline_run.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "run/run_fixture.hpp"

namespace pcrb {
namespace {

class OfflineRunTest : public RunFixture {
 protected:
  OfflineRunTest() {
    options_.run = folder_.file("run");
    options_.configuration.selection = selection_;
    options_.secret = secret_;
    options_.client = "poses.txt 12ab";
  }

  /// The ideal replies to all problems but the last, and one that is no pose.
  std::map<std::string, OfflineReply> someReplies() const {
    std::map<std::string, OfflineReply> replies;
    const RunPlan plan = makeRunPlan(selection_);
    ProblemPoser poser(selection_.root, options_.configuration.presentation, secret_);
    for (const PlannedProblem& planned : plan.problems) {
      const Transform ideal = poser.pose(planned).presentation.ideal();
      Submission& submission = replies[planned.key.problem_id].submission;
      submission.position = ideal.translation();
      submission.orientation = Eigen::Quaterniond(ideal.linear());
    }
    replies.erase("10003");
    replies.at("10002").defect = "the matrix has no rotation in it";
    return replies;
  }

  std::vector<Result> results() const {
    return ResultsStore(options_.run, ResultsStore::Access::kReadOnly).results();
  }

  OfflineRunOptions options_;
};

TEST_F(OfflineRunTest, ScoresEveryProblemInBothPresentations) {
  for (const auto kind : {PresentationKind::kRegistration, PresentationKind::kLocalization}) {
    std::filesystem::remove_all(options_.run);
    options_.configuration.presentation.kind = kind;
    OfflineRun run(options_);
    EXPECT_EQ(run.size(), 4u);
    int rows = 0;
    const std::string summary = run.score(someReplies(), [&rows] { ++rows; });
    EXPECT_EQ(rows, 4);
    EXPECT_NE(summary.find("hall"), std::string::npos);
    const std::vector<Result> stored = results();
    ASSERT_EQ(stored.size(), 4u);
    EXPECT_LT(stored[0].error, 1e-12);
    EXPECT_LT(stored[1].error, 1e-12);
    EXPECT_EQ(stored[2].outcome, Outcome::kRejected);
    EXPECT_EQ(stored[2].reason, "the matrix has no rotation in it");
    EXPECT_EQ(stored[3].outcome, Outcome::kTimedOut);
    EXPECT_EQ(stored[3].error, stored[3].initial_misalignment);
  }
}

TEST_F(OfflineRunTest, GoesOnWhereItWasAndWithItsKeyAlone) {
  OfflineRun(options_).score(someReplies(), [] {});
  OfflineRun(options_).score({}, [] {});
  EXPECT_EQ(results().at(0).outcome, Outcome::kReplied);
  options_.secret = Secret::draw();
  EXPECT_THROW(OfflineRun{options_}, StoreError);
}

}  // namespace
}  // namespace pcrb
