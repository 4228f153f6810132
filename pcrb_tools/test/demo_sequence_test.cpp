#include "pcrb_tools/demo_sequence.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/io/cloud_files.hpp"
#include "pcrb_core/io/file_hash.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem_file.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

std::string hashOfAll(const std::string& data_set) {
  std::string hashes =
      pcrb::fileHash(data_set + "/hall_local.txt") + pcrb::fileHash(data_set + "/hall_global.txt");
  for (const std::string& cloud : pcrb::findClouds(data_set + "/hall")) {
    hashes += cloud + pcrb::fileHash(data_set + "/hall/" + cloud);
  }
  return hashes;
}

TEST(DemoSequence, SameSeedGivesTheSameBytesAndAnotherSeedDoesNot) {
  const pcrb_test::TemporaryFolder first, second, other;
  makeDemoSequence(first.path(), {7, 4, 2});
  makeDemoSequence(second.path(), {7, 4, 2});
  makeDemoSequence(other.path(), {8, 4, 2});
  EXPECT_EQ(hashOfAll(first.file("demo")), hashOfAll(second.file("demo")));
  EXPECT_NE(hashOfAll(first.file("demo")), hashOfAll(other.file("demo")));
}

TEST(DemoSequence, HasTheProblemsOfItsPairsInTheFrameOfItsClouds) {
  const pcrb_test::TemporaryFolder root;
  makeDemoSequence(root.path(), {1, 4, 2});
  const pcrb::Dataset dataset = pcrb::loadDataset(root.path(), "demo");
  for (const pcrb::SequenceFiles& files : pcrb::findSequences(root.path())) {
    const auto problems = pcrb::readProblemFile(files.problem_file);
    EXPECT_EQ(problems.size(), files.kind == pcrb::Kind::kLocal ? 60u : 2u);
    for (const pcrb::Problem& problem : problems) {
      const auto source = pcrb::readPcd(files.cloud_folder + "/" + problem.source);
      EXPECT_NO_THROW(pcrb::checkFrame(pcrb::requireRigid(problem.perturbation),
                                       pcrb::centroid(source), dataset.bounds(files.kind)));
    }
  }
}

TEST(DemoSequence, ScansHaveTheSensorPoseAndStayInTheHall) {
  const pcrb_test::TemporaryFolder root;
  makeDemoSequence(root.path(), {1, 4, 1});
  const auto cloud = pcrb::readPcd(root.file("demo/hall/hall_1.pcd"));
  EXPECT_TRUE(cloud.hasViewpoint());
  for (const Eigen::Vector3d& point : cloud.points) {
    ASSERT_TRUE((point.array() > -0.1).all() && (point.array() < 20.1).all()) << point.transpose();
  }
}

}  // namespace
}  // namespace pcrb_tools
