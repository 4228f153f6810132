#include "pcrb_core/datasets/eth.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"
#include "support/decimal_comma.hpp"
#include "support/expect_error.hpp"

namespace pcrb {
namespace {

const char* const kScan =
    "Time_in_sec, x, y, z, Intensities, 2DscanId, PointId\n"
    "1314110923.5, 1.25, -2.5, 0.125, -1, 0.0, 0.0\n"
    "1314110923.6, -3.0625, 4, 1e-3, 2834, 0.0, 1.0\n";

const char* const kLeicaPoses =
    "poseId, timestamp, T00, T01, T02, T03, T10, T11, T12, T13, T20, T21, T22, T23, T30, T31, T32, "
    "T33\n"
    "0, 1314110923.5, 1, 0, 0, 0.5, 0, 1, 0, -0.25, 0, 0, 1, 2, 0, 0, 0, 1\n"
    "1.0, 1314110999.5, 0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30, 0, 0, 0, 1\n";

std::string scanWith(const std::string& row) { return std::string(kScan) + row; }

TEST(EthScan, ColumnsAreFoundByNameWhateverTheirCaseQuotesAndPlace) {
  const SensorScan scan = parseEthScan(kScan, "PointCloud0.csv");
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.points[0], Eigen::Vector3d(1.25, -2.5, 0.125));
  EXPECT_EQ(scan.points[1], Eigen::Vector3d(-3.0625, 4, 0.001));
  const SensorScan other = parseEthScan(
      "\xEF\xBB\xBF\"Z\" ,\" x \",time, Y ,Points\r\n\r\n 3,1,99,2 ,7\r\n\"6\",4,99, 5,8",
      "other.csv");
  ASSERT_EQ(other.points.size(), 2u);
  EXPECT_EQ(other.points[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(other.points[1], Eigen::Vector3d(4, 5, 6));
}

TEST(EthScan, NonFinitePointsAreCountedAndLeftOut) {
  const SensorScan scan = parseEthScan(scanWith("1, nan, 2, 3, 0, 0, 0\n"), "a.csv");
  EXPECT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.counts.read, 3u);
  EXPECT_EQ(scan.counts.non_finite, 1u);
  EXPECT_EQ(scan.counts.written(), 2u);
}

TEST(EthScan, RejectsAHeaderWithoutXYZ) {
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan("a, x, y, w\n1, 2, 3, 4\n", "a.csv"), "a.csv:1: ");
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan("x, y, z, X\n1, 2, 3, 4\n", "a.csv"),
                    "one column each");
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan("<!DOCTYPE html>\n", "a.csv"), "an HTML page");
}

TEST(EthScan, RejectsARowThatIsCutShort) {
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan(scanWith("1, 2, 3, 4, 5, 6"), "a.csv"),
                    "a.csv:4: found 6 columns in '");
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan(scanWith("1, 2, 3"), "a.csv"),
                    "a.csv:4: found 3 columns in '");
}

TEST(EthScan, RejectsARowWithMoreColumnsThanTheHeader) {
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan(scanWith("1, 2, 3, 4, 5, 6, 7, 8\n"), "a.csv"),
                    "a.csv:4: found 8 columns in '");
}

TEST(EthScan, RejectsACoordinateThatIsNoNumber) {
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan(scanWith("1, 2, abc, 4, 5, 6, 7\n"), "a.csv"),
                    "a.csv:4: ");
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan(scanWith("1, 2, 3 3, 4, 5, 6, 7\n"), "a.csv"),
                    "a number in column 3");
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan(scanWith("1, 2, , 4, 5, 6, 7\n"), "a.csv"),
                    "a number in column 3");
}

TEST(EthScan, RejectsAFileWithoutPoints) {
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan("", "a.csv"), "a.csv: found no line");
  PCRB_EXPECT_ERROR(InvalidFile, parseEthScan("x, y, z\n\n", "a.csv"), "found a header only");
}

TEST(EthScan, IsReadAlikeUnderALocaleWithDecimalComma) {
  const pcrb_test::DecimalComma comma;
  EXPECT_EQ(parseEthScan(kScan, "a.csv").points[0], Eigen::Vector3d(1.25, -2.5, 0.125));
}

TEST(LeicaPoses, ArePosesOfTheScannerInTheWorld) {
  const auto poses = parseLeicaPoses(kLeicaPoses, "pose_scanner_leica.csv");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses.at(0) * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1.5, 1.75, 5));
  EXPECT_EQ(poses.at(1) * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(8, 21, 33));
}

TEST(LeicaPoses, RejectsDefectiveRowsNamingTheLine) {
  const std::string good(kLeicaPoses);
  const auto with = [&good](const char* row) { return good + row; };
  const char* const ok_tail = ", 1, 0, 0, 0.5, 0, 1, 0, -0.25, 0, 0, 1, 2, 0, 0, 0, 1\n";
  const auto expectError = [](const std::string& text, const char* message) {
    PCRB_EXPECT_ERROR(InvalidFile, parseLeicaPoses(text, "p.csv"), message);
  };
  expectError(with("2, 9, 1, 0, 0\n"), "p.csv:4: found 5 numbers");
  expectError(with("2, 9, 1, 0, 0, 0.5, 0, 1, 0, -0.25, 0, 0, 1, 2, 0, 0, 0, 2\n"), "0 0 0 1");
  expectError(with("2, 9, 1, 0, 0, 0.5, 0, 2, 0, -0.25, 0, 0, 1, 2, 0, 0, 0, 1\n"), "a rotation");
  expectError(with("2, 9, 1, 0, 0, 0.5, 0, 1, 0, inf, 0, 0, 1, 2, 0, 0, 0, 1\n"), "not finite");
  expectError(good + "1, 9" + ok_tail, "poseId 1 again");
  expectError(good + "1.5, 9" + ok_tail, "scan number 1.5");
  expectError(good + "-1, 9" + ok_tail, "scan number -1");
  expectError(good.substr(good.find('\n') + 1), "p.csv:1: found numbers in the first line");
  expectError("poseId\n", "found no pose");
}

TEST(EthNames, SayFrameAndNumber) {
  EXPECT_EQ(parseEthScanName("PointCloud12.csv")->number, 12u);
  EXPECT_EQ(parseEthScanName("PointCloud12.csv")->frame, EthFrame::kGlobal);
  EXPECT_EQ(parseEthScanName("Hokuyo_3.csv")->frame, EthFrame::kLocal);
  for (const char* name :
       {"PointCloud.csv", "PointCloudx.csv", "PointCloud1.pcd", "aPointCloud1.csv",
        "PointCloud-1.csv", "Hokuyo3.csv", "pose_scanner_leica.csv", ""}) {
    EXPECT_FALSE(parseEthScanName(name)) << name;
  }
  EXPECT_EQ(ethCloudName(7), "PointCloud7.pcd");
}

TEST(EthNames, SequenceOfAFolderOrArchive) {
  EXPECT_EQ(ethSequenceName("plain"), "plain");
  EXPECT_EQ(ethSequenceName("plain.zip"), "plain");
  EXPECT_EQ(ethSequenceName("plain_01-Sep-2011-16_39_18"), "plain");
  EXPECT_EQ(ethSequenceName("ETH_hauptgebaude_23-Aug-2011-18_43_49.zip"), "hauptgebaude");
  EXPECT_EQ(ethSequenceName("wood_summer_25-Aug-2011-13_00_30"), "wood_summer");
  for (const char* name : {"plain_text", "plains", "explain", "csv_global", ""}) {
    EXPECT_EQ(ethSequenceName(name), "") << name;
  }
}

TEST(EthNames, PublishedSequencesHaveTheirScanCounts) {
  std::size_t scans = 0;
  for (const auto& sequence : ethSequences()) scans += sequence.scan_count;
  EXPECT_EQ(ethSequences().size(), 8u);
  EXPECT_EQ(scans, 45u + 31 + 32 + 31 + 36 + 31 + 37 + 32);
}

}  // namespace
}  // namespace pcrb
