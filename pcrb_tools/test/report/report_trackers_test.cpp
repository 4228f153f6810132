#include <gtest/gtest.h>

#include <filesystem>

#include "report/trackers.hpp"
#include "support/report_fixture.hpp"

namespace pcrb_tools {
namespace {

/// Output of `score_poses --sequence` of four scans a metre apart.
class TrackersTest : public ReportTest {
 protected:
  /// @param scale  of the estimate's steps; the third scan is lost if asked for.
  std::string addTracker(const std::string& name, double scale, bool loses_one) {
    std::filesystem::create_directories(folder_.file(name));
    std::string scans =
        "scan,stamp,error,rotation_error_rad,translation_error_m,error_or_last_pose\n";
    std::string truth, estimate;
    for (int i = 0; i < 4; ++i) {
      const std::string stamp = "100." + std::string(1, static_cast<char>('0' + i)) + "00000000";
      scans += "scan" + std::to_string(i) + ".pcd," + stamp;
      if (loses_one && i == 2) {
        scans += ",,,,0.9\n";
        continue;
      }
      scans += ",0.1,0,0.01,0.1\n";
      truth += stamp + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
      estimate += stamp + " " + std::to_string(scale * i) + " 0 0 0 0 0 1\n";
    }
    addFile(name + "/scans.csv", scans);
    addFile(name + "/truth.tum", truth);
    addFile(name + "/estimate.tum", estimate);
    addFile(name + "/map.csv", "x,y\n0.25,0.25\n3.25,0.75\n");
    return folder_.file(name);
  }
};

TEST_F(TrackersTest, AreATableInWhichLostScansCost) {
  options_.trackers = {addTracker("whole", 1.1, false), "mine=" + addTracker("lossy", 1.0, true)};
  writeReportData(options_);
  Rows rows = readCsv(options_.output + "/tables/tracking_trackers.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["tracker"] + rows[0]["scans"] + rows[0]["lost"], "whole40");
  EXPECT_EQ(rows[0]["completeness"], "1");
  EXPECT_NEAR(std::stod(rows[0]["APE m"]), std::sqrt((0.01 + 0.04 + 0.09) / 4.0), 1e-9);
  EXPECT_NEAR(std::stod(rows[0]["RPE scan m"]), 0.1, 1e-9);
  EXPECT_NEAR(std::stod(rows[0]["RPE metre m"]), 0.1, 1e-9);
  EXPECT_GT(std::stod(rows[0]["t_rel %"]), 9.9);
  EXPECT_EQ(rows[1]["tracker"] + rows[1]["lost"], "mine1");
  EXPECT_EQ(rows[1]["completeness"], "0.75");
  EXPECT_EQ(rows[1]["error"], "0.1");
  EXPECT_EQ(rows[1]["APE m"], "0");
  EXPECT_EQ(rows[0]["verdict"] + " " + rows[1]["verdict"], "complete incomplete");
  const Json report = Json::parse(read(options_.output + "/report.json"));
  ASSERT_EQ(report["trackers"]["groups"].size(), 1u) << "they had the same scans";
  const Json& group = report["trackers"]["groups"][0];
  EXPECT_EQ(group["truth"].size(), 4u);
  EXPECT_EQ(group["map"].size(), 2u);
  EXPECT_TRUE(group["trackers"][1]["errors"][2][1].is_null());
  EXPECT_NEAR(group["trackers"][1]["errors"][3][0].get<double>(), 0.3, 1e-9);
}

TEST_F(TrackersTest, AreDrawnBesideRunsAndWithoutThem) {
  options_.trackers = {addTracker("whole", 1.1, false), addTracker("lossy", 1.0, true)};
  runReportTool(options_);
  std::string page = read(options_.output + "/index.html");
  EXPECT_NE(page.find("trajectories over the map"), std::string::npos);
  EXPECT_NE(page.find("lossy: lost at 0.20 s"), std::string::npos);
  options_.runs = {addRun("good", 0.1)};
  runReportTool(options_);
  page = read(options_.output + "/index.html");
  EXPECT_NE(page.find("id=\"trackers\""), std::string::npos);
  EXPECT_NE(page.find("Local problems"), std::string::npos);
  options_.trackers.clear();
  runReportTool(options_);
  EXPECT_EQ(read(options_.output + "/index.html").find("id=\"trackers\""), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(options_.output + "/tables/tracking_trackers.csv"));
}

TEST_F(TrackersTest, AreRefusedWithADefect) {
  options_.trackers = {addTracker("a", 1.0, false)};
  std::filesystem::remove(folder_.file("a/estimate.tum"));
  EXPECT_THROW(writeReportData(options_), pcrb::InvalidFile);
  options_.trackers = {"x=" + addTracker("b", 1.0, false), "x=" + addTracker("c", 1.0, false)};
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, writeReportData(options_), "two trackers called `x`");
  options_.trackers = {addTracker("d", 1.0, false)};
  addFile("d/scans.csv", "scan,error\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, writeReportData(options_), "scans.csv:1");
}

}  // namespace
}  // namespace pcrb_tools
