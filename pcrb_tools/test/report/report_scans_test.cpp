#include <gtest/gtest.h>

#include <filesystem>

#include "report/table.hpp"
#include "support/report_fixture.hpp"

namespace pcrb_tools {
namespace {

/// A run of a localization node whose answers to seven scans of each problem approach what is true,
/// the fourth scan without an answer.
class ReportScansTest : public ReportTest {
 protected:
  void addRunOfANode() {
    pcrb::ResultsStore store(folder_.file("node"), pcrb::ResultsStore::Access::kReadWrite);
    store.setRunInfo(
        {{"secret", "0123456789abcdef0123456789abcdef"}, {"seed", "7"}, {"node_cpu_time_s", "5"}});
    for (std::size_t i = 0; i < 8; ++i) {
      pcrb::Result result = pcrb_test::fullResult("421552847" + std::to_string(1000 + i));
      result.source = "scan" + std::to_string(i) + ".pcd";
      result.initial_misalignment = 0.3;
      result.error = 0.1;
      result.scans = {scan(1, 0.4, true), scan(2, 0.5), scan(3, 0.1), scan(4),
                      scan(5, 0.1),       scan(6, 0.1), scan(7, 0.2)};
      store.add(result);
    }
    options_.runs = {folder_.file("node")};
  }

  static pcrb::ScanRecord scan(std::uint32_t number) {
    pcrb::ScanRecord record;
    record.scan = number;
    record.sent = number;
    return record;
  }

  static pcrb::ScanRecord scan(std::uint32_t number, double error, bool is_echo = false) {
    pcrb::ScanRecord record = scan(number);
    record.answered = record.sent + 0.25;
    record.is_echo = is_echo;
    record.position = Eigen::Vector3d(error, 0.0, 0.0);
    record.orientation = Eigen::Quaterniond::Identity();
    record.error = error;
    return record;
  }

  std::map<std::string, std::string> rowOf(const std::string& table, const std::string& key,
                                           const std::string& value) const {
    for (const auto& row : readCsv(options_.output + "/tables/local_" + table + ".csv")) {
      if (row.at("selection") == "total" && (key.empty() || row.at(key) == value)) return row;
    }
    ADD_FAILURE() << table << " has no row " << value;
    return {};
  }
};

TEST_F(ReportScansTest, ShowsWhatEachRuleMakesOfTheSameAnswers) {
  addRunOfANode();
  writeReportData(options_);
  const auto first = rowOf("settling", "rule", "first");
  EXPECT_EQ(first.at("median") + " " + first.at("scans") + " " + first.at("worse"), "0.5 2 8");
  const auto stable = rowOf("settling", "rule", "stable");
  EXPECT_EQ(stable.at("median") + " " + stable.at("scans") + " " + stable.at("worse"), "0.1 6 0");
  EXPECT_EQ(stable.at("settled"), "8");
  const auto deadline = rowOf("settling", "rule", "deadline");
  EXPECT_EQ(deadline.at("median") + " " + deadline.at("scans"), "0.2 7");
}

TEST_F(ReportScansTest, ShowsWhetherTheNodeKeepsUp) {
  addRunOfANode();
  writeReportData(options_);
  const auto row = rowOf("keeping_up", "", "");
  EXPECT_EQ(row.at("scans") + " " + row.at("unanswered") + " " + row.at("median"), "56 8 0.25");
  EXPECT_EQ(row.at("processor"), "0.5");  // 5 s of eight problems of 1.25 s
}

TEST_F(ReportScansTest, HasTheErrorAfterEachScanAndSaysNothingOfOtherRuns) {
  addRunOfANode();
  writeReportData(options_);
  const Json report = Json::parse(read(options_.output + "/report.json"));
  const Json& bins =
      report.at("sections")[0].at("charts").at("over_scans")[0].at("methods")[0].at("bins");
  ASSERT_EQ(bins.size(), 6u);  // an echo is no answer
  EXPECT_EQ(bins[0].at("median"), 0.5);
  EXPECT_EQ(bins[2].at("median"), 0.1);  // the scan without an answer keeps the last one
  EXPECT_EQ(bins[5].at("median"), 0.2);
  runReportTool(options_);
  const std::string page = read(options_.output + "/index.html");
  const std::string line = "do nothing: median 0.300<";
  EXPECT_NE(page.find(line, page.find("id=\"local-settling\"")), std::string::npos);
  EXPECT_NE(page.find(line, page.find("id=\"local-times\"")), std::string::npos);
  options_.runs = {addRun("other", 0.1)};
  writeReportData(options_);
  EXPECT_FALSE(std::filesystem::exists(options_.output + "/tables/local_settling.csv"));
  EXPECT_FALSE(std::filesystem::exists(options_.output + "/tables/local_keeping_up.csv"));
}

}  // namespace
}  // namespace pcrb_tools
