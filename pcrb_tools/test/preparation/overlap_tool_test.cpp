#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/overlap.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"
#include "pcrb_core/random.hpp"
#include "preparation/preparation_tools.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// Twelve clouds in `<root>/eth/plain`.
class OverlapToolTest : public ::testing::Test {
 protected:
  OverlapToolTest() {
    fs::create_directories(folder_.file("eth/plain"));
    for (int i = 0; i < 12; ++i) writeCloud(i, 300);
    options_.folder = folder_.file("eth/plain") + "/";
    options_.threads = 2;
    output_ = folder_.file("eth/plain_overlap.txt");
  }

  void writeCloud(int i, int points) {
    pcrb::DatasetCloud cloud;
    pcrb::Random random(static_cast<std::uint64_t>(i));
    for (int p = 0; p < points; ++p) {
      cloud.points.emplace_back(0.2 * i + random.uniform(0, 2), random.uniform(0, 2), 0.0);
    }
    pcrb::writePcd(cloudFile(i), cloud);
  }

  std::string cloudFile(int i) const {
    return folder_.file("eth/plain/PointCloud" + std::to_string(i) + ".pcd");
  }

  pcrb_test::TemporaryFolder folder_;
  OverlapOptions options_;
  std::string output_;
};

TEST_F(OverlapToolTest, WritesTheMatrixBesideTheFolderWithTheDataSetsDistance) {
  runOverlapTool(options_);
  const pcrb::OverlapMatrix matrix = pcrb::readOverlapMatrix(output_);
  ASSERT_EQ(matrix.names.size(), 12U);
  EXPECT_EQ(matrix.names[2], "PointCloud2.pcd");
  EXPECT_EQ(matrix.names[10], "PointCloud10.pcd");
  EXPECT_EQ(matrix.at(10, 2),
            pcrb::computeOverlap(pcrb::readPcd(cloudFile(10)), pcrb::readPcd(cloudFile(2)), 0.1));
  EXPECT_FALSE(fs::exists(output_ + ".partial"));
}

TEST_F(OverlapToolTest, KeepsACompleteOutputAndRemakesItWhenAnInputChanged) {
  runOverlapTool(options_);
  const auto made = fs::last_write_time(output_);
  const std::string text = pcrb_test::readFile(output_);
  runOverlapTool(options_);
  EXPECT_EQ(fs::last_write_time(output_), made);
  writeCloud(3, 200);
  runOverlapTool(options_);
  EXPECT_NE(pcrb_test::readFile(output_), text);
}

TEST_F(OverlapToolTest, GoesOnFromAJournalWithATornLastLine) {
  runOverlapTool(options_);
  const std::string complete = pcrb_test::readFile(output_);
  // What an interrupted run leaves behind: column 0 (here with a value that tells it apart), and
  // half of column 1.
  std::string side = pcrb_test::readFile(pcrb::sideFile(output_));
  side.resize(side.find("output_blake2b"));
  std::string journal = side + "0 1";
  for (int i = 1; i < 12; ++i) journal += " 0.125";
  std::ofstream(output_ + ".partial", std::ios::binary) << journal << "\n1 0.5 0.";
  fs::remove(output_);
  runOverlapTool(options_);
  pcrb::OverlapMatrix matrix = pcrb::readOverlapMatrix(output_);
  pcrb::OverlapMatrix expected =
      pcrb::parseOverlapMatrix(complete.data(), complete.data() + complete.size(), "complete");
  for (std::size_t source = 1; source < 12; ++source) {
    EXPECT_EQ(matrix.at(source, 0), 0.125);
    EXPECT_EQ(matrix.at(source, 1), expected.at(source, 1));
  }
}

TEST_F(OverlapToolTest, AColumnOfAJournalWithAValueThatIsNoShareIsComputedAnew) {
  runOverlapTool(options_);
  const std::string complete = pcrb_test::readFile(output_);
  std::string journal = pcrb_test::readFile(pcrb::sideFile(output_));
  journal.resize(journal.find("output_blake2b"));
  journal += "0 1";
  for (int i = 1; i < 11; ++i) journal += " 0.125";
  for (const char* value : {"7.5", "-0.5", "inf", "half"}) {
    std::ofstream(output_ + ".partial", std::ios::binary) << journal << " " << value << "\n";
    fs::remove(output_);
    runOverlapTool(options_);
    EXPECT_EQ(pcrb_test::readFile(output_), complete) << value;
  }
}

TEST_F(OverlapToolTest, AJournalOfOtherCloudsOfTheSameSizesIsBegunAnew) {
  const std::string cloud = pcrb_test::readFile(cloudFile(3));
  runOverlapTool(options_);
  std::string journal = pcrb_test::readFile(pcrb::sideFile(output_));
  journal.resize(journal.find("output_blake2b"));
  journal += "0 1";
  for (int i = 1; i < 12; ++i) journal += " 0.125";
  std::ofstream(output_ + ".partial", std::ios::binary) << journal << "\n";
  fs::remove(output_);
  const auto written = fs::last_write_time(cloudFile(3));
  std::ofstream(cloudFile(3), std::ios::binary) << cloud;
  fs::last_write_time(cloudFile(3), written - std::chrono::hours(1));  // as `cp -p` leaves it
  runOverlapTool(options_);
  EXPECT_NE(pcrb::readOverlapMatrix(output_).at(1, 0), 0.125);
}

TEST_F(OverlapToolTest, AJournalThatAKillLeftBesideACompleteMatrixIsRemoved) {
  runOverlapTool(options_);
  const auto made = fs::last_write_time(output_);
  std::ofstream(output_ + ".partial") << "what a killed run did not remove\n";
  runOverlapTool(options_);
  EXPECT_EQ(fs::last_write_time(output_), made);
  EXPECT_FALSE(fs::exists(output_ + ".partial"));
}

TEST_F(OverlapToolTest, RefusesAMatrixThatAnotherOneIsAtWorkOnAndLeavesNoLockBehind) {
  const std::string lock = output_ + ".lock";
  {
    const pcrb::FileLock other(lock);
    pcrb_test::expectError<pcrb::InvalidFile>([&] { runOverlapTool(options_); }, output_,
                                              "another compute_overlap at work on it (process ");
    EXPECT_TRUE(fs::exists(lock));
  }
  runOverlapTool(options_);
  EXPECT_FALSE(fs::exists(lock));
}

TEST_F(OverlapToolTest, JournalOfOtherParametersIsBegunAnew) {
  std::ofstream(output_ + ".partial") << "something else\n0 1 0.125\n";
  runOverlapTool(options_);
  EXPECT_NE(pcrb::readOverlapMatrix(output_).at(1, 0), 0.125);
}

TEST_F(OverlapToolTest, DoesNotReplaceAFileThatItDidNotMakeUnlessForced) {
  std::ofstream(output_) << "published\n";
  EXPECT_THROW(runOverlapTool(options_), pcrb::InvalidFile);
  EXPECT_EQ(pcrb_test::readFile(output_), "published\n");
  options_.force = true;
  runOverlapTool(options_);
  std::ofstream(output_, std::ios::app) << "edited by hand\n";
  options_.force = false;
  EXPECT_THROW(runOverlapTool(options_), pcrb::InvalidFile);
}

TEST_F(OverlapToolTest, WindowAndTargetsLeaveOtherPairsUnknown) {
  options_.window = 1;
  options_.targets = {"PointCloud4.pcd"};
  options_.excluded = {"PointCloud5.pcd"};
  options_.distance = 0.5;
  options_.output = folder_.file("window.txt");
  runOverlapTool(options_);
  const pcrb::OverlapMatrix matrix = pcrb::readOverlapMatrix(options_.output);
  ASSERT_EQ(matrix.names.size(), 11U);
  std::size_t known = 0;
  for (const double value : matrix.values) known += std::isnan(value) ? 0 : 1;
  EXPECT_EQ(known, 11U + 2U);
  EXPECT_EQ(matrix.names[5], "PointCloud6.pcd");
  EXPECT_GT(matrix.at(5, 4), 0.0);
}

TEST_F(OverlapToolTest, NamesWhatIsWrong) {
  options_.targets = {"PointCloud99.pcd"};
  EXPECT_THROW(runOverlapTool(options_), pcrb::InvalidParameter);
  options_.folder = folder_.file("eth");
  EXPECT_THROW(runOverlapTool(options_), pcrb::InvalidFile);
  std::ofstream(cloudFile(7)) << "no cloud\n";
  options_.folder = folder_.file("eth/plain");
  options_.targets.clear();
  try {
    runOverlapTool(options_);
    FAIL() << "a file that is no cloud was accepted";
  } catch (const pcrb::InvalidFile& error) {
    EXPECT_NE(std::string(error.what()).find("PointCloud7.pcd:1"), std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(fs::exists(output_));
}

}  // namespace
}  // namespace pcrb_tools
