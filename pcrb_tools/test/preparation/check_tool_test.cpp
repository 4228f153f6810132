#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"
#include "pcrb_core/random.hpp"
#include "preparation/preparation_tools.hpp"
#include "support/expect_error.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// Five clouds with viewpoints and both lists in `<root>/own/yard`.
class CheckToolTest : public ::testing::Test {
 protected:
  CheckToolTest() {
    fs::create_directories(folder_.file("own/yard"));
    std::vector<std::string> names;
    for (int i = 0; i < 5; ++i) {
      names.push_back("scan" + std::to_string(i) + ".pcd");
      pcrb::DatasetCloud cloud;
      pcrb::Random random(static_cast<std::uint64_t>(i));
      for (int p = 0; p < 500; ++p)
        cloud.points.emplace_back(random.uniform(0, 4), random.uniform(0, 4), i);
      cloud.viewpoint.translation() = Eigen::Vector3d(1, 2, 3);
      pcrb::writePcd(folder_.file("own/yard/" + names.back()), cloud);
    }
    pcrb::OverlapMatrix matrix(names);
    for (double& value : matrix.values) value = 0.7;
    pcrb::writeOverlapMatrix(folder_.file("own/yard_overlap.txt"), matrix);
    SamplingOptions sampling;
    sampling.folder = folder_.file("own/yard");
    runSamplingTool(sampling);
    options_.root = folder_.path();
    options_.overlap_pairs = 0;
    options_.threads = 2;
  }

  bool check() {
    std::ostringstream out;
    const bool is_sound = runCheckTool(options_, out);
    output_ = out.str();
    return is_sound;
  }

  bool says(const std::string& part) const { return output_.find(part) != std::string::npos; }

  pcrb_test::TemporaryFolder folder_;
  CheckOptions options_;
  std::string output_;
};

TEST_F(CheckToolTest, PassesASoundDataSetAndSaysWhatItChecked) {
  EXPECT_TRUE(check()) << output_;
  EXPECT_TRUE(says("2 problem files, 5 clouds: 0 errors, 0 warnings")) << output_;
}

TEST_F(CheckToolTest, WarningsFailOnlyWhenStrict) {
  fs::copy_file(folder_.file("own/yard/scan1.pcd"), folder_.file("own/yard/scan1_again.pcd"));
  EXPECT_TRUE(check()) << output_;
  EXPECT_TRUE(says("0 errors, 1 warning")) << output_;
  options_.strict = true;
  EXPECT_FALSE(check());
}

TEST_F(CheckToolTest, FailsForOverlapsThatAreNotTheClouds) {
  options_.overlap_pairs = 3;  // the matrix above was invented
  EXPECT_FALSE(check()) << output_;
  EXPECT_TRUE(says("error: " + folder_.file("own/yard_local.txt") + ": the overlap of 3 of 3"))
      << output_;
}

TEST_F(CheckToolTest, FailsForErrorsAndGoesOnAfterThem) {
  fs::resize_file(folder_.file("own/yard/scan3.pcd"), 200);
  std::ofstream(folder_.file("own/yard_global.txt")) << "no header\n";
  EXPECT_FALSE(check());
  EXPECT_TRUE(says("error: " + folder_.file("own/yard/scan3.pcd:"))) << output_;
  EXPECT_TRUE(says("error: " + folder_.file("own/yard_global.txt:1: found 'no header'")))
      << output_;
  EXPECT_TRUE(says("2 problem files, 5 clouds: 2 errors")) << output_;
}

TEST_F(CheckToolTest, NotesUnusedFoldersAndSingleLists) {
  fs::create_directories(folder_.file("own/attic"));
  fs::remove(folder_.file("own/yard_global.txt"));
  EXPECT_TRUE(check()) << output_;
  EXPECT_TRUE(says("note: " + folder_.file("own/attic") + ": no problem file uses it")) << output_;
  EXPECT_TRUE(says("yard_local.txt: has no global list beside it")) << output_;
}

TEST_F(CheckToolTest, ChecksCloudsWithoutProblemFiles) {
  for (const char* file : {"own/yard_local.txt", "own/yard_global.txt"}) {
    fs::remove(folder_.file(file));
  }
  EXPECT_TRUE(check()) << output_;
  EXPECT_TRUE(says("0 problem files, 5 clouds: 0 errors")) << output_;
  EXPECT_TRUE(says("note: " + folder_.file("own/yard") + ": no problem file uses it")) << output_;
  options_.sequences = {"yard"};
  fs::resize_file(folder_.file("own/yard/scan3.pcd"), 200);
  EXPECT_FALSE(check());
  EXPECT_TRUE(says("error: " + folder_.file("own/yard/scan3.pcd:"))) << output_;
}

TEST_F(CheckToolTest, ReadsTheParametersOfCloudsWithoutProblemFiles) {
  for (const char* file : {"own/yard_local.txt", "own/yard_global.txt"}) {
    fs::remove(folder_.file(file));
  }
  const auto expect = [this](const std::string& yaml, const char* message) {
    pcrb::writeFileAtomically(folder_.file("own/dataset.yaml"), yaml);
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, check(), message);
  };
  expect("overlap_distanse: 0.2\n", "dataset.yaml:1: found unknown key 'overlap_distanse'");
  expect("<html></html>\n", "found an HTML page");
  expect("version https://git-lfs.github.com/spec/v1\n", "found a Git LFS pointer");
}

TEST_F(CheckToolTest, ReportsAMissingFolderOfClouds) {
  fs::remove_all(folder_.file("own/yard"));
  EXPECT_FALSE(check());
  EXPECT_TRUE(says("error: " + folder_.file("own/yard") + ": is no folder")) << output_;
}

TEST_F(CheckToolTest, ChecksOnlyWantedSequencesAndRefusesUnknownOnes) {
  options_.sequences = {"own/yard"};
  EXPECT_TRUE(check()) << output_;
  options_.sequences = {"own/garden"};
  EXPECT_THROW(check(), pcrb::InvalidParameter);
  options_.root = folder_.file("own/yard");
  options_.sequences.clear();
  EXPECT_THROW(check(), pcrb::InvalidFile);
}

TEST_F(CheckToolTest, PassesTheSharedBenchmarkData) {
  PCRB_REQUIRE_SHARED_DATA();
  options_.root = pcrb_test::sharedData() + "/benchmark";
  options_.overlap_pairs = 2;
  options_.strict = true;
  EXPECT_TRUE(check()) << output_;
}

}  // namespace
}  // namespace pcrb_tools
