#include "benchmarking/series.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

std::vector<std::string> foldersOf(const SeriesOptions& options) {
  std::vector<std::string> folders;
  for (const SeriesRun& run : runsOfSeries(options)) folders.push_back(run.folder);
  return folders;
}

TEST(Series, HasARunPerValueAndTrial) {
  EXPECT_EQ(foldersOf({3, ""}), (std::vector<std::string>{"trial_1", "trial_2", "trial_3"}));
  EXPECT_EQ(foldersOf({1, "leaf=0.1,0.2"}), (std::vector<std::string>{"leaf=0.1", "leaf=0.2"}));
  EXPECT_EQ(foldersOf({2, "leaf=0.1,0.2"}),
            (std::vector<std::string>{"leaf=0.1/trial_1", "leaf=0.1/trial_2", "leaf=0.2/trial_1",
                                      "leaf=0.2/trial_2"}));
  EXPECT_TRUE((SeriesOptions{1, ""}.isOne()));
}

TEST(Series, KeepsTheFolderOfARunWhenTrialsAreAdded) {
  const std::vector<SeriesRun> known = runsOfSeries({1, "leaf=1,2"});
  std::vector<SeriesRun> runs = runsOfSeries({2, "leaf=2"});
  runs.push_back({"seed=2", "seed", "2", 1});
  std::string folders;
  for (const SeriesRun& run : grown(known, runs)) folders += run.folder + " ";
  EXPECT_EQ(folders, "leaf=1 leaf=2 leaf=2/trial_2 seed=2 ");
  EXPECT_EQ(runs[0].folder, "leaf=2");
  EXPECT_EQ(runs[1].folder, "leaf=2/trial_2");
}

TEST(Series, IsNotMixedWithARun) {
  const pcrb_test::TemporaryFolder folder;
  std::ofstream(folder.file("series.csv")) << "folder,parameter,value,trial\ntrial_1,,,1\n";
  BatchOptions options;
  options.run = folder.path();
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, runSeriesTool(options, {1, ""}), "holds a series");
  std::ofstream(folder.file("batch.txt")) << "x\n";
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, runSeriesTool(options, {2, ""}), "holds a run");
}

TEST(Series, IsNotNotedForAParameterThatTheMethodHasNot) {
  const pcrb_test::TemporaryFolder folder;
  std::ofstream(folder.file("icp.yaml")) << "seed: 3\n";
  BatchOptions options;
  options.run = folder.file("series");
  options.arguments = {"method:=icp", "parameters:=" + folder.file("icp.yaml")};
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, runSeriesTool(options, {1, "leaf=1,2"}),
                    "leaf: no parameter of this method");
  EXPECT_TRUE(readSeries(options.run).empty());
}

TEST(Series, RefusesASweepThatIsNone) {
  for (const char* sweep : {"leaf", "leaf=", "=0.1", "leaf=0.1,,0.2", "leaf=1,1", "leaf=../x"}) {
    PCRB_EXPECT_ERROR(pcrb::InvalidParameter, runsOfSeries({1, sweep}), "expected NAME=V1,V2");
  }
}

TEST(Series, IsReadFromItsFolder) {
  const pcrb_test::TemporaryFolder folder;
  EXPECT_TRUE(readSeries(folder.path()).empty());
  std::ofstream(folder.file("series.csv"))
      << "folder,parameter,value,trial\n\"a=1/trial_2\",a,1,2\n";
  const auto runs = readSeries(folder.path());
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].folder + " " + runs[0].parameter + " " + runs[0].value, "a=1/trial_2 a 1");
  EXPECT_EQ(runs[0].trial, 2);
  std::ofstream(folder.file("series.csv")) << "folder,parameter,value,trial\n../b,a,1,2\n";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readSeries(folder.path()), "series.csv:2");
  std::ofstream(folder.file("series.csv")) << "folder\n";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readSeries(folder.path()), "series.csv:1");
}

TEST(Series, SweepsAParameterOfAMethodWhateverTheDataSet) {
  const pcrb_test::TemporaryFolder folder;
  std::ofstream(folder.file("icp.yaml"))
      << "voxel_leaf: data_set\nseed: 3\ntum: {voxel_leaf: 0.1, seed: 4}\n";
  const std::string file = folder.file("icp.yaml");
  EXPECT_EQ(sweptParameters(file, "icp", "voxel_leaf", "0.4"),
            "# icp with another voxel_leaf, for a sweep.\nseed: 3\nvoxel_leaf: 0.4\n"
            "tum: {seed: 4}\n");
  EXPECT_NE(sweptParameters(file, "icp", "max_iterations", "5").find("max_iterations: 5\n"),
            std::string::npos);
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, sweptParameters(file, "icp", "leaf", "5"),
                    "leaf: no parameter of this method");
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, sweptParameters(file, "icp", "voxel_leaf", "-1"),
                    "voxel_leaf: found '-1'");
  std::ofstream(folder.file("mine.yaml")) << "method: icp\nseed: 1\n";
  EXPECT_NE(sweptParameters(folder.file("mine.yaml"), "mine", "seed", "2").find("method: icp\n"),
            std::string::npos);
}

}  // namespace
}  // namespace pcrb_tools
