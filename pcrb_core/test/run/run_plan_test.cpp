#include "pcrb_core/run/run_plan.hpp"

#include <gtest/gtest.h>

#include <set>

#include "pcrb_core/error.hpp"
#include "run/run_fixture.hpp"
#include "support/expect_error.hpp"

namespace pcrb {
namespace {

using pcrb_test::expectError;

class RunPlanTest : public RunFixture {
 protected:
  RunPlan plan() const { return makeRunPlan(selection_); }

  std::set<std::string> ids() const {
    std::set<std::string> ids;
    for (const PlannedProblem& planned : plan().problems) ids.insert(planned.key.problem_id);
    return ids;
  }
};

TEST_F(RunPlanTest, HasTheRowsOfTheSelectedFilesWithTheirCloudsAndHashes) {
  const RunPlan hall = plan();
  ASSERT_EQ(hall.problems.size(), 4u);
  const PlannedProblem& first = hall.problems.front();
  EXPECT_EQ(first.key, (ProblemKey{"rooms", "hall", Kind::kLocal, "10000"}));
  EXPECT_EQ(first.source_path, folder_.file("data/rooms/hall/a.pcd"));
  EXPECT_EQ(first.target_path, folder_.file("data/rooms/hall/b.pcd"));
  EXPECT_EQ(first.P.translation().x(), 0.1);
  ASSERT_EQ(hall.problem_files.size(), 1u);
  EXPECT_EQ(hall.problem_files.begin()->first, "rooms/hall_local.txt");
  EXPECT_TRUE(hall.drawn_by.empty());
  EXPECT_EQ(hall.voxel_leaves, (std::map<std::string, std::string>{{"rooms", "0.2"}}));
}

TEST_F(RunPlanTest, TakesTheKindsAndSequencesThatAreAskedFor) {
  selection_.sequences = {"all"};
  selection_.kinds = {Kind::kLocal, Kind::kGlobal};
  EXPECT_EQ(plan().problems.size(), 5u);
  selection_.kinds = {Kind::kGlobal};
  EXPECT_EQ(ids(), std::set<std::string>{"20000"});
  selection_.sequences = {"hall"};
  expectError<InvalidParameter>([&] { plan(); }, "found `hall`", "rooms/attic");
}

TEST_F(RunPlanTest, ShardsOfASubsetAreDisjointAndTogetherTheSubset) {
  selection_.subset = 3;
  const std::set<std::string> subset = ids();
  EXPECT_EQ(subset.size(), 3u);
  std::set<std::string> together;
  for (std::size_t i = 0; i < 2; ++i) {
    selection_.shard = {i, 2};
    for (const std::string& id : ids()) EXPECT_TRUE(together.insert(id).second) << id;
  }
  EXPECT_EQ(together, subset);
  selection_.shard = {4, 5};
  expectError<InvalidParameter>([&] { plan(); }, "no problem is left: found 5 shards");
}

TEST_F(RunPlanTest, RefusesAMissingCloudAndAPerturbationThatIsNotRigidWithTheirLine) {
  Problem broken = row("10001", "b.pcd", "a.pcd", 0.2);
  broken.perturbation(0, 0) = 2.0;
  writeProblems("hall_local.txt", {row("10000", "a.pcd", "b.pcd", 0.1), broken});
  expectError<InvalidFile>([&] { plan(); }, "hall_local.txt:3: transform is not rigid");
  writeProblems("hall_local.txt", {row("10000", "a.pcd", "z.pcd", 0.1)});
  expectError<InvalidFile>([&] { plan(); }, "hall_local.txt:2: found the cloud `z.pcd`");
}

TEST_F(RunPlanTest, IsServedInASecretOrderThatSaysWhereTheTargetChanges) {
  const auto ordered = inServingOrder(plan().problems, secret_);
  ASSERT_EQ(ordered.size(), 4u);
  EXPECT_TRUE(ordered[0].target_changed);
  EXPECT_FALSE(ordered[1].target_changed);
  EXPECT_TRUE(ordered[2].target_changed);
  EXPECT_FALSE(ordered[3].target_changed);
  EXPECT_EQ(problemsByKey(plan()).count(ordered[0].key), 1u);
}

TEST(ShardNumber, IsReadAsItIsWritten) {
  EXPECT_EQ(toString(shardFromString("3/12")), "3/12");
  for (const char* text : {"", "1", "/2", "2/2", "-1/2", "0/0", "1/2/3", "0/1000001", "a/b"}) {
    expectError<InvalidParameter>([text] { shardFromString(text); }, "shard: found `");
  }
}

}  // namespace
}  // namespace pcrb
