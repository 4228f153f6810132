#include "server/problem_loader.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"
#include "run/run_fixture.hpp"

namespace pcrb {
namespace {

class ProblemLoaderTest : public RunFixture {
 protected:
  void SetUp() override {
    parameters_.configuration.selection = selection_;
    problems_ = inServingOrder(makeRunPlan(selection_).problems, secret_);
  }

  ServerParameters parameters_;
  std::vector<PlannedProblem> problems_;
};

TEST_F(ProblemLoaderTest, PreparesEveryProblemInOrderWithItsMessages) {
  ProblemLoader loader(parameters_, secret_, problems_);
  loader.checkFrames();
  for (const PlannedProblem& planned : problems_) {
    const PreparedProblem prepared = loader.next();
    EXPECT_EQ(prepared.planned->key, planned.key);
    EXPECT_GT(prepared.source_message.message.num_bytes, 0u);
    EXPECT_EQ(prepared.publishes_target, planned.target_changed);
    EXPECT_EQ(prepared.target_message.message.num_bytes > 0, prepared.publishes_target);
    loader.prepareAnother();
  }
}

TEST_F(ProblemLoaderTest, EndsWithProblemsLeftAndPreparesNoneBeforeItIsAsked) {
  ProblemLoader(parameters_, secret_, problems_);
  ProblemLoader loader(parameters_, secret_, problems_);
  EXPECT_EQ(loader.next().planned->key, problems_[0].key);
}

TEST_F(ProblemLoaderTest, HandsOnWhyAProblemCannotBePosed) {
  std::filesystem::remove(problems_[0].source_path);
  ProblemLoader loader(parameters_, secret_, problems_);
  EXPECT_THROW(loader.next(), Error);
}

TEST_F(ProblemLoaderTest, FindsCloudsInAnotherFrameThanTheProblemFilesBeforeTheRun) {
  Problem far = row("10000", "a.pcd", "b.pcd", 0.1);
  far.perturbation.topLeftCorner<2, 2>() << -1.0, 0.0, 0.0, -1.0;  // about an origin 1 km off
  far.perturbation.col(3) << 2000.0, 0.0, 0.0;
  writeProblems("hall_local.txt", {far});
  problems_ = makeRunPlan(selection_).problems;
  ProblemLoader loader(parameters_, secret_, problems_);
  EXPECT_THROW(loader.checkFrames(), InvalidProblem);
}

}  // namespace
}  // namespace pcrb
