#include "pcrb_core/run/in_process_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "run/run_fixture.hpp"

namespace pcrb {
namespace {

class InProcessRunTest : public RunFixture {
 protected:
  InProcessRunTest() {
    options_.run = folder_.file("run");
    options_.client = "mine";
    options_.configuration.under_test = "mine";
    options_.configuration.selection = selection_;
  }

  InProcessRunOptions options_;
};

TEST_F(InProcessRunTest, ShowsEachProblemOnceAndScoresTheReplyThatUndoesIt) {
  InProcessRun run(options_);
  std::set<std::string> ids;
  while (const auto problem = run.next()) {
    ids.insert(problem->id);
    EXPECT_EQ(problem->source.size(), 150u);
    EXPECT_TRUE(problem->has_guess);
    Submission submission;  // the fixture moves sources along x by a tenth of a metre per id
    submission.position.x() = -0.1 * (problem->id.back() - '0' + 1);
    EXPECT_LT(run.submit(submission, 0.1).error, 1e-9);
  }
  EXPECT_EQ(ids.size(), 4u);
  EXPECT_NE(run.finish().find("hall"), std::string::npos);
  EXPECT_EQ(ResultsStore(options_.run, ResultsStore::Access::kReadOnly).count(), 4u);
}

TEST_F(InProcessRunTest, GoesOnWithTheProblemThatHasNoAnswer) {
  std::string id;
  {
    InProcessRun run(options_);
    run.next();
    run.submit({}, 0.1);
    id = run.next()->id;
  }
  InProcessRun run(options_);
  EXPECT_EQ(run.done(), 1u);
  EXPECT_EQ(run.next()->id, id);
}

TEST_F(InProcessRunTest, RejectsWhatTheServerWouldAndKeepsNothingWithoutAFolder) {
  options_.run.clear();
  InProcessRun run(options_);
  EXPECT_THROW(run.submit({}, 0.1), InvalidParameter);
  EXPECT_EQ(run.next()->id, "10000");
  Submission submission;
  submission.position.x() = std::nan("");
  EXPECT_EQ(run.score(submission, 0.1).outcome, Outcome::kRejected);
  EXPECT_EQ(run.score({}, 31.0).outcome, Outcome::kTimedOut);
  EXPECT_EQ(run.submit({}, 0.1).outcome, Outcome::kReplied);
  EXPECT_EQ(run.finish(), "");
}

}  // namespace
}  // namespace pcrb
