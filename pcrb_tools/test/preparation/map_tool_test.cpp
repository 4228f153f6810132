#include <gtest/gtest.h>

#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/random.hpp"
#include "pcrb_core/search/voxel_map.hpp"
#include "preparation/preparation_tools.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// Seven clouds in `<root>/planetary/box_met`.
class MapToolTest : public ::testing::Test {
 protected:
  MapToolTest() {
    fs::create_directories(folder_.file("planetary/box_met"));
    for (int i = 0; i < 7; ++i) {
      pcrb::DatasetCloud cloud;
      pcrb::Random random(static_cast<std::uint64_t>(i));
      for (int p = 0; p < 500; ++p) {
        cloud.points.emplace_back(i + random.uniform(0, 2), random.uniform(0, 2), 0.0);
      }
      clouds_.push_back(cloud);
      pcrb::writePcd(folder_.file("planetary/box_met/box_met_00" + std::to_string(i) + ".pcd"),
                     cloud);
    }
    options_.folder = folder_.file("planetary/box_met");
    options_.output = folder_.file("planetary/box_map.pcd");
  }

  std::string outputText() const { return std::string(pcrb::FileBytes(options_.output).text()); }

  pcrb_test::TemporaryFolder folder_;
  std::vector<pcrb::DatasetCloud> clouds_;
  MapOptions options_;
};

TEST_F(MapToolTest, IsTheVoxelMapOfAllCloudsWithAnyNumberOfThreads) {
  pcrb::VoxelMap expected(0.2);
  for (const auto& cloud : clouds_) expected.add(cloud);
  runMapTool(options_);
  EXPECT_EQ(pcrb::readPcd(options_.output).points, expected.cloud().points);
  const std::string text = outputText();
  fs::remove(options_.output);
  options_.threads = 3;
  runMapTool(options_);
  EXPECT_EQ(outputText(), text);
}

TEST_F(MapToolTest, KeepsACompleteMapAndLeavesItOutOfItself) {
  options_.output = options_.folder + "/map.pcd";
  runMapTool(options_);
  const auto made = fs::last_write_time(options_.output);
  const std::string text = outputText();
  runMapTool(options_);
  EXPECT_EQ(fs::last_write_time(options_.output), made);
  options_.leaf = 0.5;
  runMapTool(options_);
  EXPECT_LT(outputText().size(), text.size());
}

TEST_F(MapToolTest, LeavesNothingBehindWhenACloudIsBad) {
  fs::resize_file(options_.folder + "/box_met_003.pcd", 300);
  EXPECT_THROW(runMapTool(options_), pcrb::InvalidFile);
  EXPECT_FALSE(fs::exists(options_.output));
  options_.excluded = {"box_met_003.pcd"};
  EXPECT_NO_THROW(runMapTool(options_));
}

}  // namespace
}  // namespace pcrb_tools
