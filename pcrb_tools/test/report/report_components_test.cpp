#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/random.hpp"
#include "pcrb_core/run/problem_poser.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "pcrb_core/run/run_plan.hpp"
#include "report/problem_details.hpp"
#include "report/section_tables.hpp"
#include "run/some_results.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

/// A data set far from the origin with one problem, and a reply that is off by a known motion.
class ProblemDetailsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.file("own/yard"));
    pcrb::Random random(3);
    for (int i = 0; i < 200; ++i) {
      cloud_.points.push_back(
          shift_ + 20.0 * Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform()));
    }
    pcrb::writePcd(folder_.file("own/yard/a.pcd"), cloud_);
    pcrb::writePcd(folder_.file("own/yard/b.pcd"), cloud_);
    const Eigen::Vector3d center = pcrb::centroid(cloud_);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const auto P = pcrb::makePerturbation(center, {0.5, -0.2, 0.1}, turn);
    pcrb::Problem problem{"1234567890123", "a.pcd", "b.pcd", 0.75, {}};
    problem.perturbation = P.matrix().topRows<3>();
    pcrb::writeProblemFile(folder_.file("own/yard_local.txt"), {problem});
    makeEntry(pcrb::inLocalFrame(P, pcrb::chooseLocalOrigin(cloud_)), center);
  }

  void makeEntry(const pcrb::Transform& P, const Eigen::Vector3d& center) {
    const Eigen::Vector3d local = center - pcrb::chooseLocalOrigin(cloud_);
    const Eigen::Matrix3d yaw =
        Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    ScoredProblem problem;
    problem.key = {"own", "yard", pcrb::Kind::kLocal, "1234567890123"};
    problem.reply = pcrb::makePerturbation(local, {0.1, 0.0, -0.3}, yaw) * P.inverse();
    problem.rotation_error = 0.02;
    problem.translation_error = std::hypot(0.1, 0.3);
    entry_.method = "mine";
    entry_.info.emplace();  // registration
    entry_.problems = {problem};
  }

  void addComponents() {
    std::ostringstream out;
    Progress progress("errors", "problems", 1, out, false, std::chrono::steady_clock::now);
    ProblemDetails details(folder_.path());
    details.addComponents(entry_, progress);
    details.addErrorPerMetre(entry_.problems[0]);
  }

  const Eigen::Vector3d shift_{3e6, 4e6, 100.0};
  pcrb_test::TemporaryFolder folder_;
  pcrb::DatasetCloud cloud_;
  Entry entry_;
};

TEST_F(ProblemDetailsTest, AreTheErrorsOfTheReplyAlongAndAboutEachAxis) {
  addComponents();
  const auto components = entry_.problems[0].components.value();
  const std::array<double, 6> expected{0.1, 0.0, -0.3, 0.0, 0.0, 0.02};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(components[i], expected[i], 1e-4) << i;
  EXPECT_GT(entry_.problems[0].error_per_metre.value(), 1.0 / 20.0);
}

TEST_F(ProblemDetailsTest, KnowWhatDoingNothingLeaves) {
  entry_.problems[0].initial_misalignment = 0.5;
  addComponents();
  const std::vector<Entry> entries{entry_};
  const auto sections = makeSections(entries, "");
  const ScoredProblem& untouched = sections.at(0).baseline.value().problems.at(0);
  EXPECT_NEAR(untouched.rotation_error.value(), 0.4, 1e-4);
  EXPECT_NEAR(untouched.translation_error.value(), std::sqrt(0.25 + 0.04 + 0.01), 1e-4);
  ReportOptions options;
  options.recall_limits = {{0.6, 23.0}, {0.5, 23.0}, {0.6, 22.0}};  // 0.4 rad are 22.9°
  const auto recall = recallTable(sections[0], options).rows.back();
  EXPECT_EQ(Json(recall).dump(), R"(["do nothing","total",1,1.0,0.0,0.0])");
  const auto axis = componentTable(sections[0]).rows.at(12);
  EXPECT_EQ(axis[0].get<std::string>() + " " + axis[2].get<std::string>(), "do nothing x");
  EXPECT_NEAR(axis[6].get<double>(), 0.5, 1e-4);
}

TEST_F(ProblemDetailsTest, FollowTheSecretOfTheShardThatPosedTheProblem) {
  const pcrb::Secret secret = pcrb::Secret::fromHex("00112233445566778899aabbccddeeff");
  ScoredProblem& problem = entry_.problems[0];
  pcrb::RunInfo& info = *entry_.info;
  info.configuration.presentation = {pcrb::PresentationKind::kLocalization, false, true};
  pcrb::ProblemSelection selection;
  selection.root = folder_.path();
  const pcrb::RunPlan plan = pcrb::makeRunPlan(selection);
  const pcrb::PosedProblem posed =
      pcrb::ProblemPoser(folder_.path(), info.configuration.presentation, secret)
          .pose(plan.problems.front());
  const pcrb::Transform residual = *problem.reply * posed.P;
  problem.reply =
      posed.presentation.target_applied * residual * posed.presentation.applied.inverse();
  addComponents();
  EXPECT_FALSE(problem.components) << "found without a secret";
  info.shard_secrets[problem.key.subject()] = secret.toHex();
  addComponents();
  EXPECT_NEAR(problem.components.value()[2], -0.3, 1e-4);
}

TEST_F(ProblemDetailsTest, JudgeTheCovarianceOfTheReplyAgainstItsErrorInTheTargetsFrame) {
  // The reply is the truth moved by (0.1, 0, −0.3) and 0.02 rad about the source's centroid: at its
  // own position that is another translation, which an exact covariance must be compared with.
  entry_.problems[0].covariance.emplace();
  for (std::size_t i = 0; i < 6; ++i) (*entry_.problems[0].covariance)[7 * i] = 1.0;
  (*entry_.problems[0].covariance)[35] = 0.01 * 0.01;
  addComponents();
  const auto judged = entry_.problems[0].judged.value();
  EXPECT_EQ(judged.degrees, 6);
  EXPECT_NEAR(judged.normalized[5].value(), 2.0, 1e-3);
  EXPECT_NEAR(judged.normalized[3].value(), 0.0, 1e-4);
  const pcrb::Transform reply = *entry_.problems[0].reply;
  const Eigen::Vector3d center = pcrb::centroid(cloud_) - pcrb::chooseLocalOrigin(cloud_);
  const Eigen::Vector3d at_centroid(0.1, 0.0, -0.3);
  const Eigen::AngleAxisd turn(0.02, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d truth =  // of the reply's position
      turn.inverse() * (reply.translation() - center - at_centroid) + center;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(judged.normalized[static_cast<std::size_t>(i)].value(),
                (reply.translation() - truth)[i], 1e-3)
        << i;
  }
}

TEST_F(ProblemDetailsTest, LeaveACovarianceUnjudgedThatIsNone) {
  entry_.problems[0].covariance.emplace();
  (*entry_.problems[0].covariance)[0] = -1.0;
  addComponents();
  EXPECT_FALSE(entry_.problems[0].judged);
}

TEST_F(ProblemDetailsTest, KnowTheRangeOfOverlapsThatPairsWereDrawnFrom) {
  const ProblemDetails details(folder_.path());
  EXPECT_FALSE(details.overlapRangeOf("own", "yard", pcrb::Kind::kLocal));
  std::ofstream(folder_.file("own/yard_overlap.txt"))
      << "overlap a.pcd b.pcd c.pcd\na.pcd 1 0.45 0.9\nb.pcd 0.3 1 0.75\nc.pcd nan 0.5 1\n";
  const auto range = details.overlapRangeOf("own", "yard", pcrb::Kind::kLocal);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->min, 0.45);
  EXPECT_EQ(range->max, 0.9);
  EXPECT_EQ(details.overlapRangeOf("own", "yard", pcrb::Kind::kGlobal)->min, 0.75);
}

TEST_F(ProblemDetailsTest, AreUnknownOfAProblemWithoutAReply) {
  entry_.problems[0].reply.reset();
  addComponents();
  EXPECT_FALSE(entry_.problems[0].components);
  EXPECT_TRUE(entry_.problems[0].error_per_metre);
}

TEST_F(ProblemDetailsTest, AreRefusedWhereTheDataAreNotThoseOfTheRun) {
  entry_.problems[0].translation_error = 0.2;
  PCRB_EXPECT_ERROR(pcrb::InvalidProblem, addComponents(),
                    "the data sets have changed since the run");
  entry_.problems[0].key.problem_id = "17";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, addComponents(), "yard_local.txt: has no problem 17");
  entry_.problems[0].key.sequence = "garden";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, addComponents(), "has no problem file of own/garden");
}

TEST_F(ProblemDetailsTest, HaveTheOverlapOfEveryPairInAProblemFileOnce) {
  ProblemDetails details(folder_.path());
  EXPECT_EQ(details.overlapsOf("own", "yard", pcrb::Kind::kLocal), std::vector<double>{0.75});
  EXPECT_TRUE(details.overlapsOf("own", "yard", pcrb::Kind::kGlobal).empty());
}

TEST_F(ProblemDetailsTest, GiveImportedProblemsTheirCloudsAndOverlap) {
  ProblemDetails(folder_.path()).addPairs(entry_);
  EXPECT_EQ(entry_.problems[0].source, "a.pcd");
  EXPECT_EQ(entry_.problems[0].overlap, 0.75);
  EXPECT_EQ(entry_.problems[0].pair, "own/yard a.pcd b.pcd");
}

}  // namespace
}  // namespace pcrb_tools
