#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "conversion/own_request.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/own_log.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using pcrb_test::bodyAt;

std::string floats(const std::vector<float>& numbers) {
  std::string bytes(4 * numbers.size(), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n1 2 3\n";

/// The k-th pose as 12 numbers.
std::string matrixRow(std::uint32_t k) {
  return "0 -1 0 " + std::to_string(0.5 * k) + " 1 0 0 2 0 0 1 3";
}

class OwnFilesConversion : public testing::Test {
 protected:
  OwnRequest request() const {
    OwnRequest request;
    request.inputs = {folder_.file("scans")};
    request.root = folder_.file("root");
    request.data_set = "mine";
    return request;
  }

  void write(const std::string& name, const std::string& bytes) const {
    pcrb_test::writeFile(folder_.file("scans/" + name), bytes);
  }

  /// That (1, 2, 3) of the scan is where the k-th pose puts it.
  void expectPlaced(const std::string& name, std::uint32_t k) const {
    const auto cloud = pcrb::readPcd(folder_.file("root/mine/scans/" + name + ".pcd"));
    ASSERT_EQ(cloud.points.size(), 1u);
    EXPECT_LT((cloud.points[0] - bodyAt(k) * Eigen::Vector3d(1, 2, 3)).norm(), 1e-9) << name;
    EXPECT_LT((cloud.viewpoint.matrix() - bodyAt(k).matrix()).norm(), 1e-9) << name;
  }

  pcrb_test::TemporaryFolder folder_;
};

TEST_F(OwnFilesConversion, KittisRecordsAndPosesBelongTogetherByTheirNumbers) {
  write("velodyne/000000.bin", floats({1, 2, 3, 0.5}));
  write("velodyne/000002.bin", floats({1, 2, 3, 0.5}));
  write("poses.txt", matrixRow(0) + "\n" + matrixRow(1) + "\n" + matrixRow(2) + "\n");
  EXPECT_EQ(convertOwn(request()).written.size(), 2u);
  expectPlaced("000000", 0);
  expectPlaced("000002", 2);
}

TEST_F(OwnFilesConversion, PosesWithoutNumbersInTheNamesBelongToTheirOrder) {
  for (const char* name : {"a.ply", "b.ply", "c.ply"}) write(name, kPly);
  write("traj.log",
        "0 0 3\n0 -1 0 0\n1 0 0 2\n0 0 1 3\n0 0 0 1\n1 1 3\n0 -1 0 0.5\n1 0 0 2\n"
        "0 0 1 3\n0 0 0 1\n2 2 3\n0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n");
  convertOwn(request());
  expectPlaced("a", 0);
  expectPlaced("c", 2);
  write("d.ply", kPly);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()),
                    "found 3 poses without timestamps for 4 clouds, expected as many");
}

TEST_F(OwnFilesConversion, NamesWithTimestampsAreMatchedInTime) {
  write("1500000000.000000000.ply", kPly);
  write("1500000000.100000000.ply", kPly);
  const std::string q = " 2 3 0 0 0.70710678118654752 0.70710678118654752\n";
  write("groundtruth.txt", "1500000000.0 0" + q + "1500000000.2 1" + q);
  convertOwn(request());
  expectPlaced("1500000000.100000000", 1);
  write("cloud.ply", kPly);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()),
                    "cloud.ply: found a name without a timestamp");
}

TEST_F(OwnFilesConversion, TimesComeFromAFileOfALineACloud) {
  write("1.ply", kPly);
  write("2.ply", kPly);
  write("times.txt", "0\n0.1\n");
  const std::string q = ",2,3,0.70710678118654752,0,0,0.70710678118654752\n";
  write("gt.csv", "0,0" + q + "200000000,1" + q);
  convertOwn(request());
  expectPlaced("2", 1);
  write("times.txt", "0\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()),
                    "times.txt: found 1 timestamps, expected 2");
}

TEST_F(OwnFilesConversion, NamedColumnsTieFilesToPoses) {
  write("left.npy", std::string("\x93NUMPY\x01\x00\x3c\x00", 10) +
                        "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 3)}  \n" +
                        floats({1, 2, 3}));
  write("right.pcd",
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
        "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n1 2 3\n");
  write("poses.csv", "x,y,z,roll,pitch,yaw_deg,file\n1,2,3,0,0,90,right.pcd\n0,2,3,0,0,90,left\n");
  convertOwn(request());
  expectPlaced("left", 0);
  expectPlaced("right", 2);
}

TEST_F(OwnFilesConversion, CloudsInOneFrameNeedNoPoses) {
  write("a.ply", kPly);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()),
                    "found no poses, expected one file of poses (--poses), or clouds that are in "
                    "one frame already (--in-world)");
  write("poses.txt", "\xFF\xFE" + std::string("1\0", 2));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()),
                    "found no poses; " + folder_.file("scans/poses.txt") + ":1: found UTF-16 text");
  std::filesystem::remove(folder_.file("scans/poses.txt"));
  OwnRequest placed = request();
  placed.in_world = true;
  convertOwn(placed);
  const auto cloud = pcrb::readPcd(folder_.file("root/mine/scans/a.pcd"));
  EXPECT_EQ(cloud.points.at(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(cloud.hasViewpoint());
  write("poses.csv", "file,x,y,z,roll,pitch,yaw_deg\na.ply,1,2,3,0,0,90\n");
  convertOwn(placed);
  const auto posed = pcrb::readPcd(folder_.file("root/mine/scans/a.pcd"));
  EXPECT_EQ(posed.points.at(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((posed.viewpoint.matrix() - bodyAt(2).matrix()).norm(), 1e-9);
}

TEST_F(OwnFilesConversion, ListsTheFilesThatCouldBeThePoses) {
  write("a.ply", kPly);
  write("truth.txt", matrixRow(0) + "\n");
  write("estimate.txt", matrixRow(1) + "\n");
  write("calib.txt", "P0: 1 2 3\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()),
                    "found poses in " + folder_.file("scans/estimate.txt") + ", " +
                        folder_.file("scans/truth.txt") + ", expected one file of poses");
  OwnRequest chosen = request();
  chosen.poses = folder_.file("scans/truth.txt");
  convertOwn(chosen);
  expectPlaced("a", 0);
  chosen.T_body_sensor = pcrb::Transform(Eigen::Translation3d(-1, -2, -3));
  convertOwn(chosen);
  const auto cloud = pcrb::readPcd(folder_.file("root/mine/scans/a.pcd"));
  EXPECT_LT((cloud.points[0] - Eigen::Vector3d(0, 2, 3)).norm(), 1e-9);
}

/// Three formats of a scan that sees (1, 2, 3) at its stamp and 0.1 s later.
TEST_F(OwnFilesConversion, DeskewsCloudsOfEveryFormatThatHasTimes) {
  const std::string fields =
      "{'descr': [('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('time', '<f4')], "
      "'fortran_order': False, 'shape': (2,)}\n";
  write("1500000000.000000000.npy", std::string("\x93NUMPY\x01\x00", 8) +
                                        static_cast<char>(fields.size()) + '\0' + fields +
                                        floats({1, 2, 3, 0, 1, 2, 3, 0.1F}));
  write("1500000000.100000000.pcd",
        "VERSION .7\nFIELDS x y z t\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2\n"
        "HEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3 0\n1 2 3 100000000\n");
  write("1500000000.200000000.ply",
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
        "property float z\nproperty double timestamp\nend_header\n1 2 3 1500000000.2\n"
        "1 2 3 1500000000.3\n");
  const std::string q = " 2 3 0 0 0.70710678118654752 0.70710678118654752\n";
  // The clock of the poses is a minute behind that of the scans.
  write("groundtruth.txt", "1499999940.0 0" + q + "1499999940.2 1" + q + "1499999940.4 2" + q);
  OwnRequest deskewed = request();
  deskewed.deskew = true;
  deskewed.time_offset = 60.0;
  EXPECT_EQ(convertOwn(deskewed).written.size(), 3u);
  for (std::uint32_t k = 0; k != 3; ++k) {
    const auto cloud = pcrb::readPcd(
        folder_.file("root/mine/scans/1500000000." + std::to_string(k) + "00000000.pcd"));
    ASSERT_EQ(cloud.points.size(), 2u);
    for (std::uint32_t i = 0; i != 2; ++i) {
      EXPECT_LT((cloud.points[i] - bodyAt(k + i) * Eigen::Vector3d(1, 2, 3)).norm(), 1e-6) << k;
    }
  }
  // Another pose within the scan makes another cloud, though its own stamp has the same one.
  write("groundtruth.txt", "1499999940.0 0" + q + "1499999940.1 0.5" + q + "1499999940.2 3" + q +
                               "1499999940.4 2" + q);
  convertOwn(deskewed);
  const auto again = pcrb::readPcd(folder_.file("root/mine/scans/1500000000.100000000.pcd"));
  EXPECT_NEAR(again.points[1].x() - again.points[0].x(), 2.5, 1e-6);
}

TEST_F(OwnFilesConversion, RefusesTimesOfPointsInAnotherUnit) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nproperty float time\nend_header\n";
  const std::string q = " 2 3 0 0 0 1\n";
  write("groundtruth.txt", "1500000000.0 0" + q + "1500000100.0 1" + q);
  OwnRequest deskewed = request();
  deskewed.deskew = true;
  deskewed.max_gap = 200 * pcrb::kSecond;
  write("1500000000.000000000.ply", head + "1 2 3 0\n1 2 3 99\n");  // ms
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(deskewed), "found points over 99 s");
  write("1500000000.000000000.ply", head + "1 2 3 0\n1 2 3 0.0001\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(deskewed), "found points over 1e-04 s");
}

TEST_F(OwnFilesConversion, PrintsHowManyPosesALaterOneReplaced) {
  write("000000.ply", kPly);
  write("traj.log",
        "0 0 1\n1 0 0 9\n0 1 0 9\n0 0 1 9\n0 0 0 1\n0 0 1\n0 -1 0 0\n1 0 0 2\n"
        "0 0 1 3\n0 0 0 1\n");
  const std::string note = "1 poses have the stamp of a later one, or its scan, and were not used";
  EXPECT_NE(formatReport(convertOwn(request())).find(note), std::string::npos);
  expectPlaced("000000", 0);
  std::filesystem::remove(folder_.file("scans/traj.log"));
  write("1500000000.000000000.ply", kPly);
  std::filesystem::remove(folder_.file("scans/000000.ply"));
  write("poses.txt",
        "1500000000 9 9 9 0 0 0 1\n1500000000 0 2 3 0 0 0.70710678118654752 "
        "0.70710678118654752\n");
  EXPECT_NE(formatReport(convertOwn(request())).find(note), std::string::npos);
  expectPlaced("1500000000.000000000", 0);
}

TEST_F(OwnFilesConversion, PrintsWhatReadersTookAlthoughItIsOdd) {
  const std::string pcd =
      "FIELDS X Y Z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nVIEWPOINT 0 0 0 0 0 0 0\n"
      "POINTS 1\nDATA ascii\n1 2 3\n";
  write("000000.pcd", pcd);
  write("000001.pcd", pcd);
  write("poses.txt", matrixRow(0) + "\n" + matrixRow(1) + "\n");
  OwnRequest placed = request();
  const std::string posed_report = formatReport(convertOwn(placed));
  std::filesystem::remove(folder_.file("scans/poses.txt"));
  placed.in_world = true;
  for (const std::string& report : {posed_report, formatReport(convertOwn(placed))}) {
    EXPECT_NE(report.find("note: no HEIGHT: it is taken as 1 (2 clouds)"), std::string::npos);
    EXPECT_NE(report.find("note: VIEWPOINT has only zeros"), std::string::npos);
    EXPECT_NE(report.find("note: field X is taken for x (2 clouds)"), std::string::npos) << report;
  }
}

TEST_F(OwnFilesConversion, PassesOverNoOptionInSilence) {
  write("000000.ply", kPly);
  write("poses.txt", matrixRow(0) + "\n");
  OwnRequest asked = request();
  asked.pose_topic = "/odom";
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, convertOwn(asked),
                    "--topic: found no bag, expected one in place of files of clouds");
  asked = request();
  asked.time_offset = 1.0;
  PCRB_EXPECT_ERROR(
      pcrb::InvalidFile, convertOwn(asked),
      "found poses without timestamps, expected timestamps, which --time-offset needs");
  asked = request();
  asked.max_rate = 1.0;
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(asked), "which --max-rate needs");
}

TEST_F(OwnFilesConversion, ReadsCloudsFromAnArchive) {
  pcrb_test::writeArchive(folder_.file("walk.zip"),
                          {{"walk/0.ply", kPly}, {"walk/poses.txt", matrixRow(0) + "\n"}});
  OwnRequest archived = request();
  archived.inputs = {folder_.file("walk.zip")};
  EXPECT_EQ(convertOwn(archived).sequence, "walk");
}

TEST_F(OwnFilesConversion, ABagOfRos2InAFolderIsNamed) {
  write("metadata.yaml", "rosbag2_bagfile_information:\n");
  write("rosbag2_0.db3", "SQLite format 3");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()),
                    "rosbag2_0.db3: found a bag in a folder");
}

TEST_F(OwnFilesConversion, AFolderWithoutCloudsIsNamed) {
  write("a.txt", "nothing\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()), "found no cloud among 1 files");
}

}  // namespace
}  // namespace pcrb_tools
