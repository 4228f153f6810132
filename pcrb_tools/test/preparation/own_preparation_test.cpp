#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "preparation/preparation.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// Five scans of a wall, each a metre further along it, as text PLY with KITTI's poses.
class OwnPreparation : public ::testing::Test {
 protected:
  OwnPreparation() {
    std::string poses;
    for (int scan = 0; scan != 5; ++scan) {
      std::string points;
      for (int i = 0; i != 400; ++i) {
        points += pcrb::formatShortest(0.2 * (i % 20)) + " 5 " +
                  pcrb::formatShortest(0.2 * static_cast<double>(i / 20)) + "\n";
      }
      pcrb_test::writeFile(folder_.file("walk/" + std::to_string(scan) + ".ply"),
                           "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\n"
                           "property float y\nproperty float z\nend_header\n" +
                               points);
      poses += "1 0 0 " + std::to_string(scan) + " 0 1 0 0 0 0 1 0\n";
    }
    pcrb_test::writeFile(folder_.file("walk/poses.txt"), poses);
    request_.inputs = {folder_.file("walk")};
    request_.root = folder_.file("root");
    request_.data_set = "mine";
    options_.root = request_.root;
  }

  bool prepare() {
    std::ostringstream out;
    const bool is_sound = prepareOwn(request_, parameters_, options_, out);
    output_ = out.str();
    return is_sound;
  }

  std::string path(const std::string& name) const { return folder_.file("root/mine/" + name); }

  pcrb_test::TemporaryFolder folder_;
  OwnRequest request_;
  DatasetParameters parameters_;
  PrepareOptions options_;
  std::string output_;
};

TEST_F(OwnPreparation, GoesFromScansAndPosesToProblemsThatTheCheckFindsSound) {
  EXPECT_TRUE(prepare()) << output_;
  EXPECT_EQ(pcrb::findClouds(path("walk")).size(), 5u);
  const auto problems = pcrb::readProblemFile(path("walk_local.txt"));
  EXPECT_EQ(problems.size(), 3000u);
  // Neighbours share about 15 of 20 columns of points.
  for (const auto& problem : problems) EXPECT_GE(problem.overlap, 0.4);
  EXPECT_TRUE(fs::exists(path("walk_global.txt")));
  EXPECT_GT(pcrb::readPcd(path("walk_map.pcd")).points.size(), 200u);
  EXPECT_NE(output_.find("0 errors"), std::string::npos) << output_;
}

TEST_F(OwnPreparation, WritesTheParametersOnceAndKeepsToThem) {
  options_.last = PrepareStage::kConvert;
  parameters_.overlap_distance = 0.05;
  parameters_.sensor = "3D lidar: mine";
  EXPECT_TRUE(prepare()) << output_;
  const pcrb::Dataset written = pcrb::loadDataset(request_.root, "mine");
  EXPECT_EQ(written.overlap_distance, 0.05);
  EXPECT_EQ(written.voxel_leaf, 0.2);
  EXPECT_EQ(written.sensor, "3D lidar: mine");
  EXPECT_EQ(written.global.translation.max, 20.0);
  const std::string text = pcrb_test::readFile(path("dataset.yaml"));
  EXPECT_TRUE(prepare()) << output_;
  EXPECT_EQ(pcrb_test::readFile(path("dataset.yaml")), text);
  parameters_.overlap_distance = 0.1;
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, prepare(),
                    "--overlap-distance: found 0.1, expected 0.05");
}

TEST_F(OwnPreparation, ARerunKeepsWhatIsComplete) {
  EXPECT_TRUE(prepare()) << output_;
  const std::string problems = pcrb_test::readFile(path("walk_local.txt"));
  const auto made = fs::last_write_time(path("walk/0.pcd"));
  EXPECT_TRUE(prepare()) << output_;
  EXPECT_NE(output_.find("5 kept from an earlier run"), std::string::npos) << output_;
  EXPECT_EQ(fs::last_write_time(path("walk/0.pcd")), made);
  EXPECT_EQ(pcrb_test::readFile(path("walk_local.txt")), problems);
}

}  // namespace
}  // namespace pcrb_tools
