#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "report/table.hpp"
#include "support/report_fixture.hpp"
#include "support/shared_data.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

TEST_F(ReportTest, ReproducesThePublishedRowsOfPpcrToTheLastPrintedDigit) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string folder = pcrb_test::sharedData() + "/paper_results/";
  options_.format = "ppcr";
  for (const std::string sequence : {"plain", "stairs", "planetary_map"}) {
    options_.imports.push_back(folder + "ppcr_" + sequence + "_local.csv");
  }
  writeReportData(options_);
  const Rows published = readCsv(folder + "tables.csv");
  std::size_t compared = 0;
  for (auto& row : readCsv(options_.output + "/summary.csv")) {
    const auto same = std::find_if(published.begin(), published.end(), [&](auto other) {
      return other["method"] == "ppcr" && other["sequence"] == row["sequence"];
    });
    ASSERT_NE(same, published.end());
    if (row["sequence"] == "total") continue;
    for (const std::string name : {"median", "q75", "q95", "mean", "stddev"}) {
      EXPECT_EQ(pcrb::formatFixed(*pcrb::parseDouble(row[name]), 2), same->at(name))
          << row["sequence"] << " " << name;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 15u);
}

TEST_F(ReportTest, HasTheColumnsAndTheOrderOfTheSummaryFile) {
  options_.runs = {addRun("good", 0.1)};
  writeReportData(options_);
  const std::string text = read(options_.output + "/summary.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), "method,sequence,median,q75,q95,mean,stddev");
  const Rows rows = readCsv(options_.output + "/summary.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("method") + " " + rows[0].at("sequence"), "good plain");
  EXPECT_EQ(rows[1].at("sequence"), "total");
  EXPECT_EQ(*pcrb::parseDouble(rows[0].at("median")), 0.5 * (0.1 * 1.019 + 0.1 * 1.020));
}

TEST_F(ReportTest, CountsUnansweredProblemsWithTheirMisalignmentAndApart) {
  options_.runs = {addRun("flaky", 0.1, 10)};
  writeReportData(options_);
  const Rows rows = readCsv(options_.output + "/tables/local_scores.csv");
  EXPECT_EQ(rows[0].at("replied"), "30");
  EXPECT_EQ(rows[0].at("timed_out"), "10");
  EXPECT_EQ(rows[0].at("pairs"), "20");
  EXPECT_EQ(*pcrb::parseDouble(rows[0].at("q95")), 1.0);
  const Rows correlations = readCsv(options_.output + "/tables/local_correlations.csv");
  EXPECT_EQ(correlations[0].at("n"), "40");
  EXPECT_EQ(correlations[0].at("n (answered)"), "30");
  EXPECT_NEAR(*pcrb::parseDouble(correlations[0].at("rho overlap (answered)")), 1.0, 1e-12);
  EXPECT_LT(*pcrb::parseDouble(correlations[0].at("rho overlap")), 0.5);
}

TEST_F(ReportTest, SaysWhichDifferencesAreRealWithPairsOfCloudsAsUnits) {
  options_.runs = {addRun("good", 0.1), addRun("bad", 0.2), addRun("same", 0.1)};
  writeReportData(options_);
  const Rows rows = readCsv(options_.output + "/tables/local_comparisons.csv");
  // Three pairs of methods, in total and on the one sequence; then each against doing nothing.
  ASSERT_EQ(rows.size(), 12u);
  EXPECT_EQ(rows[0].at("verdict"), "good is better");
  EXPECT_EQ(rows[0].at("pairs"), "20");
  EXPECT_EQ(rows[0].at("problems"), "40");
  EXPECT_EQ(rows[1].at("verdict"), "no difference shown");
  EXPECT_EQ(rows[2].at("verdict"), "same is better");
}

TEST_F(ReportTest, WritesTheSameBytesForTheSameInput) {
  options_.runs = {addRun("good", 0.1), addRun("bad", 0.2, 3)};
  runReportTool(options_);
  std::map<std::string, std::string> first;
  for (const auto& entry : fs::recursive_directory_iterator(options_.output)) {
    if (entry.is_regular_file()) first[entry.path()] = read(entry.path());
  }
  EXPECT_GE(first.size(), 10u);
  fs::remove_all(options_.output);
  runReportTool(options_);
  for (const auto& [path, text] : first) EXPECT_TRUE(read(path) == text) << path;
}

TEST_F(ReportTest, RemovesTablesAndFiguresOfTheFormerReportAndNothingElse) {
  options_.runs = {addRun("good", 0.1), addRun("bad", 0.2)};
  writeReportData(options_);
  fs::create_directories(options_.output + "/figures");
  const auto is_there = [&](const std::string& name) {
    return fs::exists(options_.output + "/" + name);
  };
  for (const std::string name : {"tables/mine.csv", "figures/local_mine.png",
                                 "figures/local_medians.pdf", "figures/local_histograms_bad.png"}) {
    std::ofstream(options_.output + "/" + name) << "drawn";
  }
  ASSERT_TRUE(is_there("tables/local_comparisons.csv"));
  options_.runs.clear();
  options_.imports = {addFile("mine_plain_local.csv", "id,error\n1,0.5\n")};
  writeReportData(options_);
  EXPECT_FALSE(is_there("tables/local_comparisons.csv")) << "of one, with no misalignment known";
  EXPECT_FALSE(is_there("figures/local_medians.pdf"));
  EXPECT_FALSE(is_there("figures/local_histograms_bad.png"));
  EXPECT_TRUE(is_there("tables/local_scores.csv"));
  EXPECT_TRUE(is_there("tables/mine.csv"));
  EXPECT_TRUE(is_there("figures/local_mine.png"));

  std::ofstream(options_.output + "/report.json") << "{\"sections\": 1}";
  EXPECT_NO_THROW(writeReportData(options_));
}

TEST_F(ReportTest, DrawsTheSameFiguresForTheSameInput) {
  if (std::getenv("PCRB_LONG_TESTS") == nullptr) GTEST_SKIP() << "set PCRB_LONG_TESTS=1";
  options_.draw_figures = true;
  options_.runs = {addRun("good", 0.1)};
  runReportTool(options_);
  std::map<std::string, std::string> first;
  for (const auto& entry : fs::directory_iterator(options_.output + "/figures")) {
    first[entry.path()] = read(entry.path());
  }
  EXPECT_GE(first.size(), 10u);
  fs::remove_all(options_.output);
  runReportTool(options_);
  for (const auto& [path, text] : first) EXPECT_TRUE(read(path) == text) << path;
}

TEST_F(ReportTest, TellsNeitherSecretsNorAnythingButWhatItShows) {
  options_.runs = {addRun("good", 0.1)};
  runReportTool(options_);
  for (const std::string name : {"/report.json", "/index.html"}) {
    EXPECT_EQ(read(options_.output + name).find("0123456789abcdef"), std::string::npos) << name;
  }
}

TEST_F(ReportTest, NamesRunsAfterTheirFoldersOrAsToldAndRefusesOneNameTwice) {
  const std::string run = addRun("good", 0.1);
  options_.runs = {run, "mine=" + run + "/"};
  writeReportData(options_);
  EXPECT_EQ(readCsv(options_.output + "/summary.csv")[2].at("method"), "mine");
  options_.runs = {run, "good=" + run};
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, writeReportData(options_), "two runs called `good`");
  options_.runs = {};
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, writeReportData(options_), "found no run");
  options_.runs = {folder_.file("nowhere")};
  EXPECT_THROW(writeReportData(options_), pcrb::StoreError);
}

TEST_F(ReportTest, ImportsItsOwnExportedResults) {
  const std::string run = addRun("good", 0.1, 4);
  pcrb::ResultsStore(run, pcrb::ResultsStore::Access::kReadOnly).exportCsv();
  options_.runs = {run};
  options_.imports = {run + "/results.csv"};
  writeReportData(options_);
  Rows rows = readCsv(options_.output + "/tables/local_scores.csv");
  const auto imported =
      std::find_if(rows.begin(), rows.end(), [](auto row) { return row["method"] == "results"; });
  ASSERT_NE(imported, rows.end());
  imported->at("method") = "good";
  EXPECT_EQ(*imported, rows[0]);
  std::set<std::string> reasons;
  for (auto& row : readCsv(options_.output + "/tables/local_problems.csv")) {
    if (row["method"] == "results") reasons.insert(row["reason"]);
  }
  EXPECT_EQ(reasons, (std::set<std::string>{"", "found \"3\" points,\nexpected 10"}));
}

TEST_F(ReportTest, ImportsFilesThatSayNoMoreThanIdAndErrorUnderTheNameOfTheirSequence) {
  options_.imports = {
      addFile("my_yard_2_global.csv", "error,id,colour\n0.5,12,red\n0.7,13,blue\n")};
  writeReportData(options_);
  const Rows rows = readCsv(options_.output + "/tables/global_problems.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("method") + " " + rows[0].at("sequence"), "my yard_2");
  EXPECT_EQ(rows[0].at("problem"), "13");  // the worst one first
}

TEST_F(ReportTest, TellsMethodFromSequenceByKnownSequencesOrByTheNameGiven) {
  fs::create_directories(folder_.file("root/rooms/big_hall"));
  pcrb::Problem problem{"10", "a.pcd", "b.pcd", 0.5, Eigen::Matrix<double, 3, 4>::Identity()};
  pcrb::writeProblemFile(folder_.file("root/rooms/big_hall_local.txt"), {problem});
  options_.root = folder_.file("root");
  options_.with_components = false;
  const std::string text = "id,error,source\n10,0.5,a.pcd\n";
  options_.imports = {addFile("fast_gicp_plain_local.csv", text),
                      addFile("fast_vgicp_plain_local.csv", text),
                      addFile("my_icp_planetary_map_local.csv", text),
                      addFile("my_icp_big_hall_local.csv", "id,error\n10,0.5\n"),
                      addFile("some_icp_yard_2_local.csv", text),
                      "some_icp=" + addFile("some_icp_yard_3_local.csv", text),
                      "mine=" + addFile("box_met_local.csv", text),
                      "mine=" + addFile("results.csv", "id,error,source,sequence\n10,1,a,plain\n")};
  writeReportData(options_);
  std::set<std::string> read;
  for (auto& row : readCsv(options_.output + "/tables/local_problems.csv")) {
    read.insert(row["method"] + " " + row["sequence"]);
  }
  EXPECT_EQ(read,
            (std::set<std::string>{"fast_gicp plain", "fast_vgicp plain", "my_icp planetary_map",
                                   "my_icp big_hall", "some icp_yard_2", "some_icp yard_3",
                                   "mine box_met", "mine plain"}));
}

TEST_F(ReportTest, TakesARunOfDoNothingForTheBaseline) {
  options_.runs = {addRun("good", 0.1), addRun("do_nothing", 1.0)};
  writeReportData(options_);
  std::set<std::string> methods;
  for (auto& row : readCsv(options_.output + "/tables/local_scores.csv"))
    methods.insert(row["method"]);
  EXPECT_EQ(methods, (std::set<std::string>{"good", "do nothing"}));
  options_.runs = {addRun("alone/do_nothing", 1.0)};
  writeReportData(options_);
  EXPECT_EQ(readCsv(options_.output + "/summary.csv")[0]["method"], "do_nothing");
}

TEST_F(ReportTest, ShowsTrialsAndSweepsOfASeries) {
  addRun("series/voxel_leaf=0.1/trial_1", 0.1);
  addRun("series/voxel_leaf=0.1/trial_2", 0.3);
  addRun("series/voxel_leaf=0.4/trial_1", 0.5);
  addRun("series/seed=0.1", 0.7);
  addFile("series/series.csv",
          "folder,parameter,value,trial\nvoxel_leaf=0.1/trial_1,voxel_leaf,0.1,1\n"
          "voxel_leaf=0.1/trial_2,voxel_leaf,0.1,2\nvoxel_leaf=0.4/trial_1,voxel_leaf,0.4,1\n"
          "seed=0.1,seed,0.1,1\nseed=0.1/trial_2,seed,0.1,2\nseed=9,seed,9,1\n");  // not begun
  options_.runs = {"mine=" + folder_.file("series"), addRun("other", 0.2)};
  writeReportData(options_);
  Rows trials = readCsv(options_.output + "/tables/local_trials.csv");
  ASSERT_EQ(trials.size(), 2u);  // of the sequence, and in total
  EXPECT_EQ(trials[1]["method"] + " " + trials[1]["trials"], "mine voxel_leaf=0.1 2");
  EXPECT_NEAR(std::stod(trials[1]["least"]), 0.1, 0.005);
  EXPECT_NEAR(std::stod(trials[1]["largest"]), 0.3, 0.01);
  EXPECT_NEAR(std::stod(trials[1]["within median"]), 0.2, 0.01);
  EXPECT_EQ(trials[1]["changed"], "1");
  Rows sweeps = readCsv(options_.output + "/tables/local_sweeps.csv");
  ASSERT_EQ(sweeps.size(), 3u);
  EXPECT_EQ(sweeps[0]["method"], "mine seed=0.1") << "another parameter of the same value";
  EXPECT_NEAR(std::stod(sweeps[0]["median"]), 0.7, 0.02);
  EXPECT_EQ(sweeps[1]["series"] + sweeps[1]["parameter"] + sweeps[1]["value"], "minevoxel_leaf0.1");
  EXPECT_EQ(sweeps[1]["problems"], "80");
  EXPECT_EQ(sweeps[2]["problems"], "40");
  EXPECT_NEAR(std::stod(sweeps[2]["median"]), 0.5, 0.02);
  const Json report = Json::parse(read(options_.output + "/report.json"));
  EXPECT_EQ(report["sections"][0]["selections"][0]["problems"], 40);
  EXPECT_EQ(report["sections"][0]["selections"][0]["shared"], 40);
  for (auto& row : readCsv(options_.output + "/tables/local_comparisons.csv")) {
    EXPECT_EQ(row["problems"], "40");
    EXPECT_EQ(row["pairs"], "20");
  }
  const std::string command = report["sections"][0]["worst"][1]["problems"][0]["command"];
  EXPECT_NE(command.find("/series/voxel_leaf=0.4/trial_1 "), std::string::npos) << command;
  EXPECT_EQ(report["sections"][0]["charts"]["ranking"]["pairs"], 20);
  runReportTool(options_);
  EXPECT_NE(read(options_.output + "/index.html").find("mine: error over voxel_leaf"),
            std::string::npos);
}

TEST_F(ReportTest, TakesTextThatIsNoUtf8) {
  options_.runs = {
      addRun("m\xfc"
             "de",
             0.1)};  // the folder's name
  options_.imports = {addFile("my_yard_local.csv", "id,error,outcome,reason\n1,0.5,failed,\xc9\n")};
  runReportTool(options_);
  EXPECT_EQ(readCsv(options_.output + "/tables/local_problems.csv")[0].at("reason"),
            "\xef\xbf\xbd");
}

TEST_F(ReportTest, RefusesImportsWithADefectNamingFileAndLine) {
  expectImportFails("", "mine_yard_local.csv:1: found nothing, expected a header");
  expectImportFails("id,error\n", "found no row");
  expectImportFails("id,misfit\n1,2\n", ":1: found no column `error`");
  expectImportFails("id,error,error\n1,2,3\n", ":1: found column 'error' again");
  expectImportFails("id,error\n1,2\n2\n", ":3: found 1 fields, expected 2");
  expectImportFails("id,error\n1,fast\n", ":2: found 'fast', expected a number >= 0");
  expectImportFails("id,error\n1,-1\n", ":2: found '-1'");
  expectImportFails("id,error\n1,nan\n", ":2: found 'nan'");
  expectImportFails("id,error\n,1\n", ":2: found an empty field");
  expectImportFails("id,error\n1,0.5\n1,0.6\n", "problem 1 of yard twice");
  expectImportFails("id,error,outcome\n1,0.5,lost\n", ":2: ", "lost");
  expectImportFails("id,error,kind\n1,0.5,both\n", ":2: ", "both");
  options_.format = "ppcr";
  expectImportFails("id,error\n1,0.5\n", ":1: found no column `initial_misalignment`");
  expectImportFails("id,initial_misalignment,error,x\n1,2,3,4\n", ":1: found 4 columns");
}

TEST_F(ReportTest, ShowsTheFloorsOfTheGroundTruth) {
  options_.runs = {addRun("good", 0.1)};
  options_.ground_truth =
      addFile("truth.csv", "data_set,sequence,pairs,mean,stddev\neth,plain,9,0.05,0.02\n");
  writeReportData(options_);
  const Rows rows = readCsv(options_.output + "/tables/local_ground_truth.csv");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("mean"), "0.05");
  options_.ground_truth = addFile("truth.csv", "sequence,mean,stddev\nplain,0.05,0.02\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, writeReportData(options_), "no column `data_set`");
  options_.ground_truth = addFile("truth.csv", "data_set,sequence,mean,stddev\neth,plain,x,1\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, writeReportData(options_), "truth.csv:2: found 'x'");
}

}  // namespace
}  // namespace pcrb_tools
