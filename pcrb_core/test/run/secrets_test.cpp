/// The texts from which a run's secrets are derived: other bytes would give other sensor poses, so
/// other scores, and another order and other ids to runs that go on. The values are those of the
/// first version; they follow from SipHash-2-4 of these texts alone.

#include <gtest/gtest.h>

#include "pcrb_core/problem/presentation.hpp"
#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/run/run_record.hpp"
#include "run/run_fixture.hpp"

namespace pcrb {
namespace {

const Eigen::Quaterniond kYaw(-0.97807797795574181, 0.0, 0.0, 0.20823897098767921);
const Eigen::Quaterniond kRotation(-0.25121665705124041, 0.9567507902435991, -0.0096746582866837124,
                                   0.14637116374232986);

class SecretsTest : public RunFixture {
 protected:
  PosedProblem pose(PresentationOptions presentation) {
    problems_ = makeRunPlan(selection_).problems;
    return ProblemPoser(selection_.root, presentation, secret_).pose(problems_.at(0));
  }

  static Transform sensorPoseOf(const PosedProblem& posed) {
    return posed.presentation.applied.inverse();
  }

  std::vector<PlannedProblem> problems_;
};

TEST_F(SecretsTest, AreDerivedFromDataSetSequenceKindAndId) {
  EXPECT_EQ((ProblemKey{"rooms", "hall", Kind::kLocal, "10000"}.subject()),
            "rooms/hall local 10000");
  EXPECT_EQ((ProblemKey{"eth", "apartment", Kind::kGlobal, "4215528470030"}.subject()),
            "eth/apartment global 4215528470030");
}

TEST_F(SecretsTest, GiveAProblemItsIdInASession) {
  RunConfiguration configuration;
  configuration.selection = selection_;
  const RunPlan plan = makeRunPlan(selection_);
  const RunRecord record(folder_.file("run"), configuration, plan, secret_);
  EXPECT_EQ(record.publicId(plan.problems[0]), "577035fb104137c9b0c47e568dded54f");
}

TEST_F(SecretsTest, TurnAScanWithAViewpointAboutItsZ) {
  const Transform V = sensorPoseOf(pose({PresentationKind::kLocalization, false}));
  EXPECT_TRUE(V.linear().isApprox(kYaw.toRotationMatrix(), 1e-12));
  EXPECT_TRUE(V.translation().isApprox(Eigen::Vector3d(1.0, 2.0, 0.5), 1e-12));
}

TEST_F(SecretsTest, TurnAScanWithoutAViewpointByAnyRotationOrAboutZ) {
  addClouds("hall", {"a.pcd", "b.pcd"}, false);
  const PosedProblem posed = pose({PresentationKind::kLocalization, false});
  EXPECT_TRUE(sensorPoseOf(posed).linear().isApprox(kRotation.toRotationMatrix(), 1e-12));
  EXPECT_TRUE(sensorPoseOf(posed).translation().isApprox(posed.source->metric->centroid(), 1e-12));
  const Transform V = sensorPoseOf(pose({PresentationKind::kLocalization, true}));
  EXPECT_TRUE(V.linear().isApprox(kYaw.toRotationMatrix(), 1e-12));
}

TEST_F(SecretsTest, OrderTheProblems) {
  EXPECT_EQ(secret_.bits("order", "rooms/hall"), 11407021023025035948u);
}

}  // namespace
}  // namespace pcrb
