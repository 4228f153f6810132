#include <gtest/gtest.h>

#include <filesystem>

#include "conversion/converters.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "support/decimal_comma.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

const std::string kGlobalHeader = "Time_in_sec, x, y, z, Intensities, 2DscanId, PointId\n";
const std::string kLeicaPoses =
    "poseId, timestamp, T00, T01, T02, T03, T10, T11, T12, T13, T20, T21, T22, T23, T30, T31, T32, "
    "T33\n"
    "0, 1314110923.5, 0.36, 0.48, -0.8, 100.125, -0.8, 0.6, 0, -20.5, 0.48, 0.64, 0.6, 1.75, "
    "0, 0, 0, 1\n"
    "10, 1314110999.5, 0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30, 0, 0, 0, 1\n";

/// Points of the scanner; those of the world are computed by naiveWorld.
const double kLocal0[2][3] = {{1.25, -2.5, 0.125}, {-3.0625, 4.0, 0.5}};
const double kLocal10[1][3] = {{7.0, 8.0, 9.0}};

std::vector<double> naiveWorld(int scan, const double* p) {
  if (scan == 10) return {-p[1] + 10, p[0] + 20, p[2] + 30};
  return {0.36 * p[0] + 0.48 * p[1] - 0.8 * p[2] + 100.125, -0.8 * p[0] + 0.6 * p[1] - 20.5,
          0.48 * p[0] + 0.64 * p[1] + 0.6 * p[2] + 1.75};
}

std::string globalRow(int scan, const double* p) {
  std::string row = "1314110923.5";
  for (const double coordinate : naiveWorld(scan, p)) {
    row += ", " + pcrb::formatShortest(coordinate);
  }
  return row + ", -1, 0.0, 0.0\n";
}

std::string localRow(const double* p) {
  return "\"1314110923.5\"," + pcrb::formatShortest(p[0]) + "," + pcrb::formatShortest(p[1]) + "," +
         pcrb::formatShortest(p[2]) + ",-1,0,0\r\n";
}

pcrb_test::NamedFiles globalFiles() {
  return {{"PointCloud0.csv",
           kGlobalHeader + globalRow(0, kLocal0[0]) + globalRow(0, kLocal0[1]) + "1,nan,0,0,0,0,0"},
          {"PointCloud10.csv", kGlobalHeader + globalRow(10, kLocal10[0])}};
}

pcrb_test::NamedFiles localFiles() {
  const std::string header =
      "\"Time_in_sec\",\"X\",\"Y\",\"Z\",\"Intensities\",\"2DscanId\",\"Points\"\r\n";
  return {{"csv_local/Hokuyo_0.csv", header + localRow(kLocal0[0]) + localRow(kLocal0[1])},
          {"csv_local/Hokuyo_10.csv", header + localRow(kLocal10[0])},
          {"leica/pose_scanner_leica.csv", kLeicaPoses}};
}

class EthConversion : public testing::Test {
 protected:
  EthRequest request(const std::string& input) const {
    EthRequest request;
    request.inputs = {input};
    request.root = folder_.file("root");
    return request;
  }

  std::string cloudPath(const std::string& name) const {
    return folder_.file("root/eth/apartment/" + name);
  }

  void expectClouds() const {
    const auto first = pcrb::readPcd(cloudPath("PointCloud0.pcd"));
    ASSERT_EQ(first.points.size(), 2u);
    for (std::size_t i = 0; i != 2; ++i) {
      const auto expected = naiveWorld(0, kLocal0[i]);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(first.points[i][axis], expected[static_cast<std::size_t>(axis)], 1e-6);
      }
    }
    const auto other = pcrb::readPcd(cloudPath("PointCloud10.pcd"));
    ASSERT_EQ(other.points.size(), 1u);
    EXPECT_NEAR(other.points[0].x(), 2.0, 1e-6);
  }

  pcrb_test::TemporaryFolder folder_;
  const std::string log_ = folder_.file("apartment_03-Dec-2011-18_13_33");
};

TEST_F(EthConversion, GlobalAndLocalFilesGiveTheSameCloud) {
  pcrb_test::writeFiles(log_ + "/csv_global", globalFiles());
  pcrb_test::writeFiles(log_, localFiles());
  const ConversionReport global = convertEth(request(log_));
  EXPECT_EQ(global.sequence, "apartment");
  EXPECT_EQ(global.written, (std::set<std::string>{"PointCloud0.pcd", "PointCloud10.pcd"}));
  EXPECT_EQ(global.points.read, 4u);
  EXPECT_EQ(global.points.non_finite, 1u);
  expectClouds();
  const auto viewpoint = pcrb::readPcd(cloudPath("PointCloud0.pcd")).viewpoint;
  EXPECT_LT((viewpoint.translation() - Eigen::Vector3d(100.125, -20.5, 1.75)).norm(), 1e-9);
  EXPECT_NEAR(viewpoint.linear()(0, 2), -0.8, 1e-9);
  EthRequest local = request(log_);
  local.frame = pcrb::EthFrame::kLocal;
  const ConversionReport report = convertEth(local);
  EXPECT_EQ(report.scans_kept, 0u);
  EXPECT_EQ(report.points.read, 3u);
  expectClouds();
  EXPECT_TRUE(pcrb::readPcd(cloudPath("PointCloud0.pcd")).viewpoint.isApprox(viewpoint, 1e-9));
}

TEST_F(EthConversion, AFlatZipWithoutPosesHasNoViewpointAndSaysSo) {
  const std::string zip = log_ + "/csv_global/global_frame.zip";
  fs::create_directories(log_ + "/csv_global");
  pcrb_test::writeArchive(zip, globalFiles());
  const ConversionReport report = convertEth(request(zip));
  expectClouds();
  EXPECT_FALSE(pcrb::readPcd(cloudPath("PointCloud0.pcd")).hasViewpoint());
  const std::string text = formatReport(report);
  EXPECT_NE(text.find("VIEWPOINT is not set"), std::string::npos) << text;
  EXPECT_NE(text.find("the published sequence has 45 scans"), std::string::npos) << text;
  EXPECT_NE(text.find("4 points read, 3 written, 1 dropped as not finite"), std::string::npos)
      << text;
}

TEST_F(EthConversion, ATgzOfLocalScansIsConvertedWhateverTheOrderOfItsEntries) {
  const std::string tgz = folder_.file("apartment.tgz");
  pcrb_test::writeArchive(tgz, localFiles());  // the poses come last
  EXPECT_EQ(convertEth(request(tgz)).sequence, "apartment");
  expectClouds();
}

TEST_F(EthConversion, ARerunKeepsWhatIsCompleteAndUnchangedOnly) {
  pcrb_test::writeFiles(log_, globalFiles());
  convertEth(request(log_));
  const auto time = fs::last_write_time(cloudPath("PointCloud0.pcd"));
  ConversionReport report = convertEth(request(log_));
  EXPECT_EQ(report.scans_kept, 2u);
  EXPECT_EQ(report.points.read, 4u);
  EXPECT_EQ(fs::last_write_time(cloudPath("PointCloud0.pcd")), time);
  pcrb_test::writeFile(log_ + "/PointCloud10.csv", kGlobalHeader + "1,5,6,7,0,0,0\n");
  report = convertEth(request(log_));
  EXPECT_EQ(report.scans_kept, 1u);
  EXPECT_EQ(pcrb::readPcd(cloudPath("PointCloud10.pcd")).points.at(0).x(), 5.0);
  pcrb_test::writeFile(log_ + "/pose_scanner_leica.csv", kLeicaPoses);
  EXPECT_EQ(convertEth(request(log_)).scans_kept, 0u);  // now there are viewpoints
}

TEST_F(EthConversion, BytesDoNotDependOnTheNumberOfThreads) {
  pcrb_test::NamedFiles files;
  for (int i = 0; i < 12; ++i) {
    files.emplace_back("PointCloud" + std::to_string(i) + ".csv",
                       kGlobalHeader + "1," + std::to_string(i) + ".5,2,3,0,0,0\n");
  }
  pcrb_test::writeFiles(log_, files);
  convertEth(request(log_));
  EthRequest parallel = request(log_);
  parallel.root = folder_.file("parallel");
  parallel.threads = 4;
  EXPECT_EQ(convertEth(parallel).written.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    const std::string name = "PointCloud" + std::to_string(i) + ".pcd";
    EXPECT_EQ(pcrb_test::readFile(cloudPath(name)),
              pcrb_test::readFile(parallel.root + "/eth/apartment/" + name));
  }
}

TEST_F(EthConversion, ADefectiveScanNamesFileAndLineAndLeavesNothingHalfWritten) {
  auto files = globalFiles();
  files[1].second += "1, 2, 3\n";
  pcrb_test::writeFiles(log_, files);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertEth(request(log_)),
                    "PointCloud10.csv:3: found 3 columns in '");
  for (const auto& name : pcrb_test::namesIn(fs::path(cloudPath("")).string())) {
    EXPECT_TRUE(name == ".conversion" || name == "PointCloud0.pcd") << name;
  }
}

TEST_F(EthConversion, LocalScansNeedTheirPoses) {
  auto files = localFiles();
  files.emplace_back("csv_local/Hokuyo_11.csv", files[0].second);
  pcrb_test::writeFiles(log_, files);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertEth(request(log_)), "found no pose of scan 11");
  fs::remove(log_ + "/leica/pose_scanner_leica.csv");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertEth(request(log_)), "found no pose of scan 0");
}

TEST_F(EthConversion, FilesOfTwoSequencesAreNotMixed) {
  pcrb_test::writeFiles(folder_.file("both/apartment"), globalFiles());
  pcrb_test::writeFiles(folder_.file("both/plain"), globalFiles());
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertEth(request(folder_.file("both"))),
                    "the same scan as");
}

TEST_F(EthConversion, TheSequenceIsFoundInThePathOrAsked) {
  const std::string unknown = folder_.file("logs");
  pcrb_test::writeFiles(unknown, globalFiles());
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, convertEth(request(unknown)), "--sequence");
  EthRequest named = request(unknown);
  named.sequence = "cellar";
  EXPECT_EQ(convertEth(named).sequence, "cellar");
  const std::string main_building = folder_.file("ETH_hauptgebaude_23-Aug-2011-18_43_49");
  pcrb_test::writeFiles(main_building + "/csv_global", globalFiles());
  EXPECT_EQ(convertEth(request(main_building)).sequence, "hauptgebaude");
}

TEST_F(EthConversion, HostileEntriesWriteNothing) {
  auto files = globalFiles();
  files.emplace_back("../../PointCloud1.csv", files[0].second);
  pcrb_test::writeArchive(folder_.file("apartment.zip"), files);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertEth(request(folder_.file("apartment.zip"))),
                    "found the name '../../PointCloud1.csv'");
  EXPECT_EQ(pcrb_test::namesIn(folder_.path()), std::vector<std::string>{"apartment.zip"});
}

TEST_F(EthConversion, ALogWithoutScansIsAnError) {
  pcrb_test::writeFile(log_ + "/readme.txt", "nothing here");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertEth(request(log_)),
                    "PointCloudN.csv or Hokuyo_N.csv");
}

TEST_F(EthConversion, WorksUnderALocaleWithDecimalComma) {
  const pcrb_test::DecimalComma comma;
  pcrb_test::writeFiles(log_, localFiles());
  convertEth(request(log_));
  expectClouds();
}

}  // namespace
}  // namespace pcrb_tools
