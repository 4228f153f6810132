#include "pcrb_core/run/problem_poser.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "pcrb_core/io/pcd.hpp"

namespace pcrb {
namespace {

/// Two clouds near the origin and problems between them.
class ProblemPoserTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "pcrb_XXXXXX";
    root_ = mkdtemp(name.data());
    DatasetCloud cloud;
    for (int i = 0; i < 50; ++i) cloud.points.emplace_back(i % 5, i % 7, i % 3);
    for (const char* file : {"a.pcd", "b.pcd"}) writePcd(path(file), cloud);
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  std::string path(const std::string& file) const { return root_ + "/" + file; }

  PlannedProblem problem(const std::string& source, const std::string& target) const {
    PlannedProblem planned;
    planned.key = {"data", "sequence", Kind::kLocal, source + target};
    planned.data_set = std::make_shared<Dataset>();
    planned.source_path = path(source);
    planned.target_path = path(target);
    return planned;
  }

  std::string root_;
  const Secret secret_ = Secret::draw();
};

TEST_F(ProblemPoserTest, LoadsACloudOnceThatIsASourceAndThenATarget) {
  ProblemPoser poser(root_, {}, secret_);
  const PlannedProblem there = problem("a.pcd", "b.pcd");
  const PlannedProblem back = problem("b.pcd", "a.pcd");
  const PosedProblem first = poser.pose(there);
  for (const char* file : {"a.pcd", "b.pcd"}) std::filesystem::remove(path(file));
  const PosedProblem second = poser.pose(back);
  EXPECT_EQ(second.target, first.source);
  EXPECT_EQ(second.source, first.target);
}

}  // namespace
}  // namespace pcrb
