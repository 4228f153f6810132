// PCL as the oracle: on valid files its reader and ours give the same points.

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <random>
#include <string>

#include "pcrb_core/io/pcd.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

/// PCL's points without those that are not finite.
template <typename Point>
std::vector<Point> readWithPcl(const std::string& path) {
  pcl::PointCloud<Point> cloud;
  if (pcl::io::loadPCDFile(path, cloud) != 0) throw std::runtime_error("PCL cannot read " + path);
  std::vector<Point> points;
  for (const Point& p : cloud) {
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) points.push_back(p);
  }
  return points;
}

/// The number of points of both readers, after checking that they are the same floats.
std::size_t expectSamePoints(const std::string& path) {
  const DatasetCloud ours = readPcd(path);
  const auto theirs = readWithPcl<pcl::PointXYZ>(path);
  EXPECT_EQ(ours.points.size(), theirs.size()) << path;
  if (ours.points.size() != theirs.size()) return 0;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    const Eigen::Vector3f point = ours.points[i].cast<float>();
    EXPECT_EQ(point, Eigen::Vector3f(theirs[i].x, theirs[i].y, theirs[i].z)) << path << " " << i;
    if (testing::Test::HasFailure()) break;
  }
  return theirs.size();
}

pcl::PointCloud<pcl::PointXYZI> someCloud() {
  std::mt19937_64 bits(3);
  const auto number = [&] { return static_cast<float>(bits() % 200000) * 1e-3f - 100.0f; };
  pcl::PointCloud<pcl::PointXYZI> cloud(40, 25);
  for (auto& p : cloud) {
    p.x = number();
    p.y = number();
    p.z = number();
    p.intensity = number();
  }
  cloud.at(3, 4).y = std::nanf("");
  cloud.is_dense = false;
  cloud.sensor_origin_ << 1, 2, 3, 1;
  cloud.sensor_orientation_ = Eigen::Quaternionf(0.5f, 0.5f, -0.5f, 0.5f);
  return cloud;
}

void expectSameIntensityAndPose(const std::string& path) {
  const DatasetCloud ours = readPcd(path);
  const auto theirs = readWithPcl<pcl::PointXYZI>(path);
  ASSERT_EQ(ours.intensity.size(), theirs.size());
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    ASSERT_EQ(ours.intensity[i], theirs[i].intensity);
  }
  EXPECT_EQ(ours.dropped_non_finite, 1u);
  EXPECT_EQ(ours.viewpoint.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(PcdOracle, ReadsWhatPclWritesInEachEncoding) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.pcd");
  const auto cloud = someCloud();
  pcl::PCDWriter writer;
  ASSERT_EQ(writer.writeASCII(path, cloud), 0);
  EXPECT_EQ(expectSamePoints(path), 999u);
  expectSameIntensityAndPose(path);
  ASSERT_EQ(writer.writeBinary(path, cloud), 0);
  EXPECT_EQ(expectSamePoints(path), 999u);
  expectSameIntensityAndPose(path);
  ASSERT_EQ(writer.writeBinaryCompressed(path, cloud), 0);
  EXPECT_EQ(expectSamePoints(path), 999u);
  expectSameIntensityAndPose(path);
}

TEST(PcdOracle, ReadsPaddedMessagesAsPclWritesThem) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.pcd");
  const auto cloud = someCloud();
  pcl::PCLPointCloud2 padded;  // point step 32, so that PCL writes `_` fields
  pcl::toPCLPointCloud2(cloud, padded);
  pcl::PCDWriter writer;
  ASSERT_EQ(writer.writeASCII(path, padded, cloud.sensor_origin_, cloud.sensor_orientation_), 0);
  EXPECT_EQ(expectSamePoints(path), 999u);
  ASSERT_EQ(writer.writeBinary(path, padded, cloud.sensor_origin_, cloud.sensor_orientation_), 0);
  EXPECT_EQ(expectSamePoints(path), 999u);
  expectSameIntensityAndPose(path);
  ASSERT_EQ(
      writer.writeBinaryCompressed(path, padded, cloud.sensor_origin_, cloud.sensor_orientation_),
      0);
  EXPECT_EQ(expectSamePoints(path), 999u);
  expectSameIntensityAndPose(path);
}

TEST(PcdOracle, PclReadsWhatWeWrite) {
  const pcrb_test::TemporaryFolder folder;
  DatasetCloud cloud;
  for (const auto& p : someCloud()) {
    if (std::isfinite(p.y)) cloud.points.emplace_back(p.x, p.y, p.z);
  }
  cloud.points.emplace_back(1e5, -1e-7, 1.0 / 3.0);
  writePcd(folder.file("a.pcd"), cloud);
  EXPECT_EQ(expectSamePoints(folder.file("a.pcd")), 1000u);
}

TEST(PcdOracle, SharedCloudsHaveThePointsThatPclReads) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string data = pcrb_test::sharedData();
  EXPECT_EQ(expectSamePoints(data + "/rgbd/binary_xyzi.pcd"), 69088u);
  EXPECT_EQ(expectSamePoints(data + "/rgbd/bun0.pcd"), 397u);
  EXPECT_GT(expectSamePoints(data + "/rgbd/office1.pcd"), 100000u);
  EXPECT_GT(expectSamePoints(data + "/rgbd/table_scene_mug_stereo_textured.pcd"), 100000u);
  EXPECT_EQ(expectSamePoints(data + "/benchmark/automotive/street/scan1.pcd"), 64685u);
  EXPECT_EQ(expectSamePoints(data + "/benchmark/handheld/car/scan400.pcd"), 24989u);
  EXPECT_EQ(expectSamePoints(data + "/benchmark/rgbd/livingroom/frame4.pcd"), 67262u);
}

}  // namespace
}  // namespace pcrb
