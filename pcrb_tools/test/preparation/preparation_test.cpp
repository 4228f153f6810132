#include "preparation/preparation.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// `data set/sequence: inputs without the folder`.
std::vector<std::string> textOf(const std::vector<SequenceLog>& logs, const std::string& folder) {
  std::vector<std::string> lines;
  for (const auto& log : logs) {
    std::string line = log.data_set + '/' + log.sequence + ':';
    for (const auto& input : log.inputs) line += ' ' + fs::relative(input, folder).string();
    lines.push_back(line);
  }
  return lines;
}

TEST(FindLogs, NamesSequencesAfterFoldersArchivesAndBags) {
  const pcrb_test::TemporaryFolder logs;
  pcrb_test::writeFiles(logs.path(),
                        {{"eth/apartment_03-Dec-2011-18_13_33/csv_global/PointCloud0.csv", ""},
                         {"eth/plain.zip", ""},
                         {"eth/cellar/PointCloud0.csv", ""},
                         {"kaist/urban05_data.tgz", ""},
                         {"kaist/urban05_pose.tgz", ""},
                         {"kaist/urban05.bag", ""},
                         {"planetary/box_met/box_met_001.xyz", ""},
                         {"planetary/p2at_met.zip", ""},
                         {"tum/rgbd_dataset_freiburg2_pioneer_slam.bag", ""},
                         {"tum/rgbd_dataset_freiburg2_pioneer_slam-2hz-with-pointclouds.bag", ""},
                         {"tum/rgbd_dataset_freiburg2_pioneer_slam-groundtruth.txt", ""},
                         {"tum/rgbd_dataset_freiburg3_long_office_household.tgz", ""},
                         {"readme.txt", ""}});
  EXPECT_EQ(
      textOf(findLogs(logs.path()), logs.path()),
      (std::vector<std::string>{
          "eth/apartment: eth/apartment_03-Dec-2011-18_13_33",
          "eth/cellar: eth/cellar",
          "eth/plain: eth/plain.zip",
          "kaist/urban05: kaist/urban05_data.tgz kaist/urban05_pose.tgz",
          "planetary/box_met: planetary/box_met",
          "planetary/p2at_met: planetary/p2at_met.zip",
          "tum/long_office_household: tum/rgbd_dataset_freiburg3_long_office_household.tgz",
          "tum/pioneer_slam: tum/rgbd_dataset_freiburg2_pioneer_slam-2hz-with-pointclouds.bag",
      }));
}

TEST(FindLogs, AFolderWithoutLogsIsAnError) {
  const pcrb_test::TemporaryFolder logs;
  pcrb_test::writeFile(logs.file("elsewhere/a.csv"), "");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, findLogs(logs.path()), "found no log");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, findLogs(logs.file("no")), "found no log");
}

/// Scans of a plane with a wave, 0.3 m apart from each other; 4 m long, so that neighbours overlap.
void writePlanetaryLog(const std::string& folder, const std::string& set, int scans) {
  for (int i = 0; i < scans; ++i) {
    const std::string stem = set + "_00" + std::to_string(i);
    std::string points;
    for (int k = 0; k < 1600; ++k) {
      const double x = 0.1 * (k % 40);
      const int row = k / 40;
      const double y = 0.1 * row;
      points += std::to_string(x) + ' ' + std::to_string(y) + ' ' +
                std::to_string(0.3 * ((k * 7) % 5)) + '\n';
    }
    pcrb_test::writeFile(folder + '/' + stem + ".xyz", points);
    pcrb_test::writeFile(folder + '/' + stem + ".gt",
                         "1 0 0 " + std::to_string(0.3 * i) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  }
}

class Preparation : public testing::Test {
 protected:
  Preparation() {
    writePlanetaryLog(folder_.file("logs/planetary/box_met"), "box_met", 6);
    writePlanetaryLog(folder_.file("logs/planetary/p2at_met"), "p2at_met", 6);
    options_.logs = folder_.file("logs");
    options_.root = folder_.file("root");
  }

  bool prepare() {
    std::ostringstream out;
    const bool good = prepareDataset(options_, out);
    text_ = out.str();
    return good;
  }

  std::string made(const std::string& name) const { return folder_.file("root/planetary/" + name); }

  pcrb_test::TemporaryFolder folder_;
  PrepareOptions options_;
  std::string text_;
};

TEST_F(Preparation, LogsBecomeProblemsThatPassTheCheck) {
  ASSERT_TRUE(prepare()) << text_;
  for (const char* name : {"box_met_local.txt", "p2at_met_global.txt", "planetary_map_local.txt",
                           "planetary_map_global.txt"}) {
    EXPECT_FALSE(pcrb::readProblemFile(made(name)).empty()) << name;
  }
  for (const auto& problem : pcrb::readProblemFile(made("planetary_map_global.txt"))) {
    EXPECT_EQ(problem.target, "box_map.pcd");
  }
  for (const auto& problem : pcrb::readProblemFile(made("p2at_met_local.txt"))) {
    EXPECT_NE(problem.target, "box_map.pcd");
  }
}

TEST_F(Preparation, ARerunChangesNothing) {
  ASSERT_TRUE(prepare());
  std::map<std::string, fs::file_time_type> times;
  for (const auto& entry : fs::recursive_directory_iterator(options_.root)) {
    if (entry.path().extension() == ".pcd" || entry.path().extension() == ".txt") {
      times.emplace(entry.path().string(), entry.last_write_time());
    }
  }
  ASSERT_TRUE(prepare());
  EXPECT_NE(text_.find("6 kept from an earlier run"), std::string::npos) << text_;
  for (const auto& [path, time] : times) EXPECT_EQ(fs::last_write_time(path), time) << path;
}

TEST_F(Preparation, ProblemFilesThatWereThereBeforeAreKept) {
  options_.last = PrepareStage::kOverlap;
  ASSERT_TRUE(prepare());
  const std::string published =
      "id source target overlap t1 t2 t3 t4 t5 t6 t7 t8 t9 t10 t11 t12\n"
      "123456789000 box_met_000.pcd box_met_001.pcd 0.5 1 0 0 0.5 0 1 0 0 0 0 1 0\n";
  pcrb_test::writeFile(made("box_met_local.txt"), published);
  options_.last = PrepareStage::kProblems;
  ASSERT_TRUE(prepare());
  EXPECT_EQ(pcrb_test::readFile(made("box_met_local.txt")), published);
  EXPECT_TRUE(fs::exists(made("box_met_global.txt")));
}

TEST_F(Preparation, AMapThatWasThereBeforeIsKept) {
  options_.last = PrepareStage::kConvert;
  ASSERT_TRUE(prepare());
  fs::copy_file(made("box_met/box_met_002.pcd"), made("p2at_met/box_map.pcd"));
  options_.last = PrepareStage::kCheck;
  ASSERT_TRUE(prepare()) << text_;
  EXPECT_EQ(pcrb_test::readFile(made("p2at_met/box_map.pcd")),
            pcrb_test::readFile(made("box_met/box_met_002.pcd")));
  EXPECT_NE(text_.find("kept, as it was there before: " + made("p2at_met/box_map.pcd")),
            std::string::npos)
      << text_;
  EXPECT_FALSE(pcrb::readProblemFile(made("planetary_map_local.txt")).empty());
}

TEST_F(Preparation, CloudsThatAreNotOfTheLogStopItBeforeTheyGetIntoProblems) {
  options_.last = PrepareStage::kConvert;
  ASSERT_TRUE(prepare());
  fs::copy_file(made("box_met/box_met_002.pcd"), made("box_met/mine.pcd"));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, prepare(),
                    "planetary/box_met: found 1 clouds that were not made of this log, the first "
                    "is mine.pcd");
}

TEST_F(Preparation, ALogWithFewerScansLeavesNoCloudOfTheEarlierRunInTheProblems) {
  options_.sequences = {"box_met"};
  ASSERT_TRUE(prepare());
  fs::remove(folder_.file("logs/planetary/box_met/box_met_005.xyz"));
  ASSERT_TRUE(prepare()) << text_;
  EXPECT_FALSE(fs::exists(made("box_met/box_met_005.pcd")));
  for (const auto& problem : pcrb::readProblemFile(made("box_met_local.txt"))) {
    EXPECT_NE(problem.source, "box_met_005.pcd");
    EXPECT_NE(problem.target, "box_met_005.pcd");
  }
}

TEST_F(Preparation, SequencesAreSelectedByAnyOfTheirNamesOnce) {
  options_.last = PrepareStage::kConvert;
  options_.sequences = {"box_met", "planetary/box_met"};
  ASSERT_TRUE(prepare());
  EXPECT_EQ(text_.find("box_met: 6 scans read"), text_.rfind("box_met: 6 scans read")) << text_;
  EXPECT_FALSE(fs::exists(made("p2at_met")));
  options_.sequences = {"all"};
  ASSERT_TRUE(prepare());
  EXPECT_TRUE(fs::exists(made("p2at_met/p2at_met_005.pcd")));
}

TEST_F(Preparation, StagesEndWhereAsked) {
  options_.last = PrepareStage::kConvert;
  options_.sequences = {"planetary/box_met"};
  ASSERT_TRUE(prepare());
  EXPECT_TRUE(fs::exists(made("box_met/box_met_005.pcd")));
  EXPECT_FALSE(fs::exists(made("p2at_met")));
  EXPECT_FALSE(fs::exists(made("box_met_overlap.txt")));
}

TEST_F(Preparation, AFailedCheckIsAFailure) {
  options_.last = PrepareStage::kProblems;
  ASSERT_TRUE(prepare());
  pcrb_test::writeFile(made("box_met_local.txt"),
                       "id source target overlap t1 t2 t3 t4 t5 t6 t7 t8 t9 t10 t11 t12\n"
                       "123456789000 box_met_000.pcd gone.pcd 0.5 1 0 0 0.5 0 1 0 0 0 0 1 0\n");
  fs::remove(made("box_met_local.txt.yaml"));
  options_.last = PrepareStage::kCheck;
  EXPECT_FALSE(prepare());
  EXPECT_NE(text_.find("gone.pcd"), std::string::npos) << text_;
}

TEST_F(Preparation, ADefectiveLogStopsItWithSequenceFileAndLineAndAWayOn) {
  pcrb_test::writeFile(folder_.file("logs/planetary/p2at_met/p2at_met_003.gt"), "1 0 0\n");
  pcrb_test::expectError<pcrb::InvalidFile>(
      [&] { prepare(); },
      "planetary/p2at_met: ", "p2at_met_003.gt:1: ", "name the sequences to prepare without it");
  options_.sequences = {"box_met"};
  EXPECT_TRUE(prepare());
}

TEST_F(Preparation, ASequenceWithoutALogIsAMistake) {
  options_.sequences = {"eth/apartment"};
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, prepare(), "found no log of eth/apartment");
}

}  // namespace
}  // namespace pcrb_tools
