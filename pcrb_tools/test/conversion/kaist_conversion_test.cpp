#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "conversion/converters.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "support/bag_writer.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using Cloud = std::vector<float>;  // x y z each

const char* const kLeftCalibration =
    "Left Velodyne (VLP-16) extrinsic calibration parameter from vehicle\n"
    "RPY(roll/pitch/yaw, degree), R(rotation matrix), T(translation matrix)\n"
    "RPY: 1 2 3\nR: 0 -1 0 1 0 0 0 0 1\nT: -0.5 0.25 2\n";
const char* const kRightCalibration = "RPY: 1 2 3\nR: 1 0 0 0 1 0 0 0 1\nT: -0.5 -0.25 2\n";

/// 100 Hz from …400 ms on, at UTM magnitude, the vehicle turned by a quarter, 0.125 m a step.
std::string poses() {
  std::string text;
  for (int i = 0; i < 30; ++i) {
    text += std::to_string(1519102894400000000 + i * 10000000LL) + ",0,-1,0," +
            std::to_string(332100.125 + 0.125 * i) + ",1,0,0,4140500.25,0,0,1,21.5\n";
  }
  return text;
}

std::string bin(const Cloud& xyz) {
  std::string bytes;
  for (std::size_t i = 0; i != xyz.size(); i += 3) {
    const float record[4] = {xyz[i], xyz[i + 1], xyz[i + 2], 7.0f};
    bytes.append(reinterpret_cast<const char*>(record), sizeof(record));
  }
  return bytes;
}

constexpr pcrb::Stamp kLeft = 1519102894479453001;   // closest pose: i = 8
constexpr pcrb::Stamp kRight = 1519102894521000123;  // closest pose: i = 12

Eigen::Vector3d naiveLeft(double x, double y, double z) {
  const double vehicle[3] = {-y - 0.5, x + 0.25, z + 2};
  return {-vehicle[1] + 332100.125 + 0.125 * 8, vehicle[0] + 4140500.25, vehicle[2] + 21.5};
}

Eigen::Vector3d naiveRight(double x, double y, double z) {
  const double vehicle[3] = {x - 0.5, y - 0.25, z + 2};
  return {-vehicle[1] + 332100.125 + 0.125 * 12, vehicle[0] + 4140500.25, vehicle[2] + 21.5};
}

const Cloud kLeftScan{1.5f, -2.f, 0.5f, 0.f, 0.f, 0.f, 40.f, 30.f, 1.f};
const Cloud kRightScan{-3.f, 4.f, 5.f};

pcrb_test::NamedFiles logFiles() {
  const std::string data = "sensor_data/";
  return {{data + "VLP_left/" + std::to_string(kLeft) + ".bin", bin(kLeftScan)},
          {data + "VLP_left/1519102894379453000.bin", bin(kLeftScan)},
          {data + "VLP_left/1519102894999000000.bin", bin(kLeftScan)},
          {data + "VLP_right/" + std::to_string(kRight) + ".bin", bin(kRightScan)},
          {data + "VLP_right/1519102894421000000.bin", bin(kRightScan)},
          {data + "VLP_left_stamp.csv", "1519102894379453000\n" + std::to_string(kLeft) +
                                            "\n1519102894999000000\n1519102895099000000\n"},
          {data + "VLP_right_stamp.csv",
           "1519102894421000000\r\n" + std::to_string(kRight) + "\r\n1519102894481000000\r\n"},
          {"calibration/Vehicle2LeftVLP.txt", kLeftCalibration},
          {"calibration/Vehicle2RightVLP.txt", kRightCalibration},
          {"global_pose.csv", poses()}};
}

class KaistConversion : public testing::Test {
 protected:
  KaistRequest request(const std::string& input) const {
    KaistRequest request;
    request.inputs = {input};
    request.root = folder_.file("root");
    return request;
  }

  pcrb::DatasetCloud cloud() const {
    return pcrb::readPcd(
        folder_.file("root/kaist/urban05/urban05_" + std::to_string(kLeft) + ".pcd"));
  }

  void expectCloud(const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) const {
    const auto result = cloud();
    ASSERT_EQ(result.points.size(), 3u);
    EXPECT_LT((result.points[0] - offset - naiveLeft(1.5, -2, 0.5)).norm(), 1e-4);
    EXPECT_LT((result.points[1] - offset - naiveLeft(40, 30, 1)).norm(), 1e-4);
    EXPECT_LT((result.points[2] - offset - naiveRight(-3, 4, 5)).norm(), 1e-4);
    EXPECT_LT((result.viewpoint.translation() - offset - naiveLeft(0, 0, 0)).norm(), 1e-6);
  }

  pcrb_test::TemporaryFolder folder_;
  const std::string log_ = folder_.file("urban05-highway");
};

TEST_F(KaistConversion, LeftAndRightScansAreMergedEachThroughItsOwnPose) {
  pcrb_test::writeFiles(log_, logFiles());
  const ConversionReport report = convertKaist(request(log_));
  EXPECT_EQ(report.sequence, "urban05");
  EXPECT_EQ(report.written, std::set<std::string>{"urban05_1519102894479453001.pcd"});
  EXPECT_EQ(report.points.read, 4u);
  EXPECT_EQ(report.points.at_origin, 1u);
  expectCloud();
}

TEST_F(KaistConversion, ScansWithoutPosePartnerOrFileAreDroppedAndReported) {
  pcrb_test::writeFiles(log_, logFiles());
  pcrb_test::writeFile(log_ + "/sensor_data/VLP_right/1.bin", "");
  const ConversionReport report = convertKaist(request(log_));
  EXPECT_EQ(report.scans_read, 4u);
  EXPECT_EQ(report.dropped.at("before the first pose").size(), 1u);
  EXPECT_EQ(report.dropped.at("no right scan close in time").size(), 1u);
  EXPECT_EQ(report.dropped.at("listed, but without a file").size(), 1u);
  const std::string text = formatReport(report);
  EXPECT_NE(text.find("1 right scans are listed, but without a file"), std::string::npos) << text;
  EXPECT_NE(text.find("1 files of scans are not listed"), std::string::npos) << text;
}

TEST_F(KaistConversion, AnArchiveGivesTheSameCloudAndLeavesNoSpoolBehind) {
  pcrb_test::writeArchive(folder_.file("urban05.tgz"), logFiles());
  convertKaist(request(folder_.file("urban05.tgz")));
  expectCloud();
  EXPECT_EQ(pcrb_test::namesIn(folder_.file("root/kaist/urban05")),
            (std::vector<std::string>{".conversion", "urban05_1519102894479453001.pcd"}));
}

TEST_F(KaistConversion, PiecesOfALogMayComeAsSeveralInputs) {
  pcrb_test::NamedFiles data;
  pcrb_test::NamedFiles rest;
  for (const auto& file : logFiles()) (file.first[0] == 's' ? data : rest).push_back(file);
  pcrb_test::writeArchive(folder_.file("urban05_data.tgz"), data);
  pcrb_test::writeFiles(folder_.file("urban05_pose"), rest);
  KaistRequest both = request(folder_.file("urban05_data.tgz"));
  both.inputs.push_back(folder_.file("urban05_pose"));
  convertKaist(both);
  expectCloud();
}

TEST_F(KaistConversion, ABagOfTheTwoTopicsGivesTheSameCloud) {
  const auto header = [](pcrb::Stamp stamp) {
    return pcrb_test::headerAt(static_cast<std::uint32_t>(stamp / pcrb::kSecond),
                               static_cast<std::uint32_t>(stamp % pcrb::kSecond), "velodyne");
  };
  const pcrb_test::CloudLayout layout{0, 32, 1, 0, "intensity"};
  const std::string bag = folder_.file("urban05.bag");
  pcrb_test::BagWriter(bag)
      .add("/ns1/velodyne_points", makeCloud(header(1519102894379453000), kLeftScan, layout))
      .add("/ns2/velodyne_points", makeCloud(header(1519102894421000000), kRightScan, layout))
      .add("/ns1/velodyne_points", makeCloud(header(kLeft), kLeftScan, layout))
      .add("/ns2/velodyne_points", makeCloud(header(kRight), kRightScan, layout))
      .add("/ns1/velodyne_points", makeCloud(header(1519102894999000000), kLeftScan, layout));
  pcrb_test::writeFiles(
      folder_.path(),
      {{"l.txt", kLeftCalibration}, {"r.txt", kRightCalibration}, {"p.csv", poses()}});
  KaistRequest asked = request(bag);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertKaist(asked), "Vehicle2LeftVLP.txt");
  asked.left_calibration = folder_.file("l.txt");
  asked.right_calibration = folder_.file("r.txt");
  asked.poses = folder_.file("p.csv");
  const ConversionReport report = convertKaist(asked);
  EXPECT_EQ(report.written.size(), 1u);
  EXPECT_EQ(report.dropped.at("before the first pose").size(), 1u);
  EXPECT_EQ(report.dropped.at("no right scan close in time").size(), 1u);
  expectCloud();
}

TEST_F(KaistConversion, TheFrameOffsetIsAddedToCloudAndViewpoint) {
  pcrb_test::writeFiles(log_, logFiles());
  KaistRequest shifted = request(log_);
  shifted.options.frame_offset = {370000.5, 3904500.25, -3.0};
  convertKaist(shifted);
  expectCloud(shifted.options.frame_offset);
}

TEST_F(KaistConversion, PosesAreInterpolatedOnRequest) {
  pcrb_test::writeFiles(log_, logFiles());
  KaistRequest interpolated = request(log_);
  interpolated.options.interpolate = true;
  convertKaist(interpolated);
  const double steps = 7.9453001;
  EXPECT_NEAR(cloud().points.at(0).x(), naiveLeft(1.5, -2, 0.5).x() + 0.125 * (steps - 8.0), 1e-4);
}

TEST_F(KaistConversion, ReturnsAtTheOriginAreKeptOnRequest) {
  pcrb_test::writeFiles(log_, logFiles());
  KaistRequest keeping = request(log_);
  keeping.origin = pcrb::OriginPoints::kKeep;
  EXPECT_EQ(convertKaist(keeping).points.written(), 4u);
}

TEST_F(KaistConversion, WithoutListsTheFilesThemselvesAreTheScans) {
  pcrb_test::writeFiles(log_, logFiles());
  fs::remove(log_ + "/sensor_data/VLP_left_stamp.csv");
  fs::remove(log_ + "/sensor_data/VLP_right_stamp.csv");
  convertKaist(request(log_));
  expectCloud();
}

TEST_F(KaistConversion, ARerunKeepsWhatIsUnchanged) {
  pcrb_test::writeArchive(folder_.file("urban05.tgz"), logFiles());
  convertKaist(request(folder_.file("urban05.tgz")));
  EXPECT_EQ(convertKaist(request(folder_.file("urban05.tgz"))).scans_kept, 1u);
  KaistRequest shifted = request(folder_.file("urban05.tgz"));
  shifted.options.frame_offset = {1.0, 0.0, 0.0};
  EXPECT_EQ(convertKaist(shifted).scans_kept, 0u);
}

TEST_F(KaistConversion, DefectsNameTheirFileAndLeaveNothingHalfWritten) {
  const auto expectError = [this](const std::string& file, const std::string& bytes,
                                  const std::string& message) {
    fs::remove_all(log_);
    pcrb_test::writeFiles(log_, logFiles());
    pcrb_test::writeFile(log_ + '/' + file, bytes);
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertKaist(request(log_)), message);
  };
  const std::string scan = "sensor_data/VLP_left/" + std::to_string(kLeft) + ".bin";
  expectError(scan, bin(kLeftScan) + "x", ".bin: found 49 bytes");
  EXPECT_EQ(pcrb_test::namesIn(folder_.file("root/kaist/urban05")),
            std::vector<std::string>{".conversion"});
  expectError("sensor_data/VLP_left/a.bin", "", "a.bin: found another name");
  expectError("sensor_data/VLP_left_stamp.csv", "1\n1.5e18\n", "VLP_left_stamp.csv:2: ");
  expectError("calibration/Vehicle2LeftVLP.txt", "RPY: 1 2 3\n", "found no line 'R:'");
  expectError("global_pose.csv", poses() + "1519102894400000000,0\n", "global_pose.csv:31: ");
  expectError("more/global_pose.csv", poses(), "found 2 files global_pose.csv");
}

TEST_F(KaistConversion, TheSequenceIsFoundInThePathOrAsked) {
  const std::string unknown = folder_.file("logs");
  pcrb_test::writeFiles(unknown, logFiles());
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, convertKaist(request(unknown)), "--sequence");
}

TEST_F(KaistConversion, ARealCalibrationFileIsUsed) {
  PCRB_REQUIRE_SHARED_DATA();
  pcrb_test::writeFiles(log_, logFiles());
  KaistRequest real = request(log_);
  real.left_calibration = pcrb_test::sharedData() + "/kaist/calibration/Vehicle2LeftVLP.txt";
  convertKaist(real);
  const double vehicle_y = 0.486485 * 1.5 + 0.711672 * 2 + 0.506809 * 0.5 + 0.397052;
  EXPECT_NEAR(cloud().points.at(0).x(), -vehicle_y + 332100.125 + 1.0, 1e-4);
}

}  // namespace
}  // namespace pcrb_tools
