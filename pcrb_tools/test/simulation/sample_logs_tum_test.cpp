#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <regex>

#include "pcrb_core/error.hpp"
#include "simulation/props.hpp"
#include "support/expect_error.hpp"
#include "support/sample_log_support.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;
using pcrb_test::numbersOf;
using pcrb_test::readLines;
using pcrb_test::TemporaryFolder;

constexpr char kClouds[] = "tum/rgbd_dataset_freiburg2_pioneer_slam-2hz-with-pointclouds.bag";
constexpr char kRaw[] = "tum/rgbd_dataset_freiburg3_long_office_household.bag";
constexpr char kTracking[] = "tum/rgbd_dataset_freiburg2_pioneer_slam-groundtruth.txt";

class TumLogs : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    pcrb_test::makeLogs(planTumLogs(pcrb_test::tinyLogs()), folder_->path());
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string file(const std::string& name) { return folder_->file(name); }

  template <typename Message>
  static std::vector<Message> read(const std::string& bag_name, const std::string& topic) {
    const rosbag::Bag bag(file(bag_name));
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    std::vector<Message> messages;
    for (const rosbag::MessageInstance& instance : view) {
      messages.push_back(*instance.instantiate<Message>());
      EXPECT_EQ(instance.getTime(), messages.back().header.stamp);
    }
    return messages;
  }

  static TemporaryFolder* folder_;
};
TemporaryFolder* TumLogs::folder_ = nullptr;

std::vector<std::vector<double>> trackedPoses(const std::string& path) {
  std::vector<std::vector<double>> poses;
  for (const std::string& line : readLines(path)) {
    if (line[0] != '#') poses.push_back(numbersOf(line));
  }
  return poses;
}

TEST_F(TumLogs, CloudsAreOrganizedWithTheLayoutOfTheDriver) {
  const auto clouds = read<sensor_msgs::PointCloud2>(kClouds, "/camera/rgb/points");
  ASSERT_EQ(clouds.size(), 6U);
  for (std::size_t i = 1; i < clouds.size(); ++i) {
    const sensor_msgs::PointCloud2& cloud = clouds[i];
    EXPECT_EQ(cloud.header.frame_id, "/openni_rgb_optical_frame");
    EXPECT_EQ(cloud.width, 80U);
    EXPECT_EQ(cloud.height, 60U);
    EXPECT_EQ(cloud.point_step, 32U);
    EXPECT_EQ(cloud.row_step, 80U * 32U);
    EXPECT_EQ(cloud.data.size(), 60U * 80U * 32U);
    EXPECT_FALSE(cloud.is_dense);
    ASSERT_EQ(cloud.fields.size(), 4U);
    const std::uint32_t offsets[] = {0, 4, 8, 16};
    const char* names[] = {"x", "y", "z", "rgb"};
    for (std::size_t f = 0; f < 4; ++f) {
      EXPECT_EQ(cloud.fields[f].name, names[f]);
      EXPECT_EQ(cloud.fields[f].offset, offsets[f]);
      EXPECT_EQ(cloud.fields[f].datatype, sensor_msgs::PointField::FLOAT32);
    }
  }
}

TEST_F(TumLogs, SomeCloudsHaveNoColor) {
  const auto first = read<sensor_msgs::PointCloud2>(kClouds, "/camera/rgb/points").at(0);
  EXPECT_EQ(first.fields.size(), 3U);
  EXPECT_EQ(first.point_step, 16U);
  const auto others = read<sensor_msgs::PointCloud2>(kClouds, "/camera/depth/points");
  ASSERT_EQ(others.size(), 2U);
  for (const auto& cloud : others) EXPECT_EQ(cloud.fields.size(), 3U);
}

TEST_F(TumLogs, PointsAreThoseOfTheirPixelsOrAllNan) {
  const auto cloud = read<sensor_msgs::PointCloud2>(kClouds, "/camera/rgb/points").at(1);
  int missing = 0;
  for (std::size_t i = 0; i < 60U * 80U; ++i) {
    float point[3];
    std::memcpy(point, cloud.data.data() + 32 * i, sizeof(point));
    if (std::isnan(point[2])) {
      EXPECT_TRUE(std::isnan(point[0]) && std::isnan(point[1]));
      ++missing;
      continue;
    }
    const double u = static_cast<double>(i % 80);
    const std::size_t row = i / 80;
    const double v = static_cast<double>(row);
    EXPECT_NEAR(point[0], (u - (320.0 / 8.0 - 0.5)) / (525.0 / 8.0) * point[2], 1e-5);
    EXPECT_NEAR(point[1], (v - (240.0 / 8.0 - 0.5)) / (525.0 / 8.0) * point[2], 1e-5);
  }
  EXPECT_GT(missing, 60 * 80 / 50);
  EXPECT_LT(missing, 60 * 80 / 2);
}

TEST_F(TumLogs, RawBagHasDepthInMetresColorAndIntrinsics) {
  const auto depths = read<sensor_msgs::Image>(kRaw, "/camera/depth/image");
  const auto colors = read<sensor_msgs::Image>(kRaw, "/camera/rgb/image_color");
  const auto infos = read<sensor_msgs::CameraInfo>(kRaw, "/camera/rgb/camera_info");
  ASSERT_EQ(depths.size(), 10U);
  ASSERT_EQ(colors.size(), 10U);
  ASSERT_EQ(infos.size(), 10U);
  EXPECT_EQ(depths[3].encoding, "32FC1");
  EXPECT_EQ(depths[3].step, 80U * 4U);
  EXPECT_EQ(depths[3].data.size(), 60U * 80U * 4U);
  EXPECT_EQ(colors[3].encoding, "rgb8");
  EXPECT_EQ(colors[3].data.size(), 60U * 80U * 3U);
  EXPECT_EQ(infos[3].K[0], 525.0 / 8.0);
  EXPECT_EQ(infos[3].K[2], 320.0 / 8.0 - 0.5);
  EXPECT_EQ(infos[3].header.stamp, depths[3].header.stamp);
}

TEST_F(TumLogs, AFullDiskIsAnErrorThatNamesTheBag) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("tum"));
  const std::string name = std::filesystem::path(kClouds).filename().string();
  std::filesystem::create_symlink("/dev/full", folder.file("tum/." + name + ".tmp"));
  pcrb_test::expectError<pcrb::InvalidFile>(
      [&] { pcrb_test::makeLogs(planTumLogs(pcrb_test::tinyLogs()), folder.path()); }, name);
  EXPECT_FALSE(std::filesystem::exists(folder.file(kClouds)));
}

TEST_F(TumLogs, TrackingIsSpelledAsPublishedWithADuplicateFlipsAndAGap) {
  const auto lines = readLines(file(kTracking));
  EXPECT_EQ(lines.at(0), "# ground truth trajectory");
  EXPECT_EQ(lines.at(2), "# timestamp tx ty tz qx qy qz qw");
  const std::regex row("[0-9]{10}\\.[0-9]{4}( -?[0-9]+\\.[0-9]{4}){7}");
  for (std::size_t i = 3; i < lines.size(); ++i)
    ASSERT_TRUE(std::regex_match(lines[i], row)) << lines[i];

  const auto poses = trackedPoses(file(kTracking));
  int duplicates = 0;
  int flips = 0;
  int gaps = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double step = poses[i][0] - poses[i - 1][0];
    double product = 0.0;
    for (std::size_t q = 4; q < 8; ++q) product += poses[i][q] * poses[i - 1][q];
    EXPECT_GT(std::abs(product), 0.99);
    duplicates += step == 0.0;
    flips += product < 0.0;
    gaps += step > 0.1;
    EXPECT_GE(step, 0.0);
    EXPECT_LT(step, 0.7);
  }
  EXPECT_EQ(duplicates, 1);
  EXPECT_GE(flips, 1);
  EXPECT_EQ(gaps, 1);
}

/// Pose in the tracking file between the neighbours of a time; nothing in a gap.
std::optional<pcrb::Transform> interpolated(const std::vector<std::vector<double>>& poses,
                                            double time) {
  std::size_t i = 1;
  while (i + 1 < poses.size() && poses[i][0] < time) ++i;
  const double span = poses[i][0] - poses[i - 1][0];
  if (poses[i][0] < time || poses[i - 1][0] > time || span > 0.1) return std::nullopt;
  const double share = span > 0.0 ? (time - poses[i - 1][0]) / span : 0.0;
  const auto rotation = [&](std::size_t k) {
    return Eigen::Quaterniond(poses[k][7], poses[k][4], poses[k][5], poses[k][6]).normalized();
  };
  const auto position = [&](std::size_t k) {
    return Vector3d(poses[k][1], poses[k][2], poses[k][3]);
  };
  return pcrb::makeTransform(position(i - 1) + share * (position(i) - position(i - 1)),
                             rotation(i - 1).slerp(share, rotation(i)));
}

TEST_F(TumLogs, CloudsMovedByTheTrackingLieOnTheOfficeAndOneHasNoPose) {
  const Scene office(describeOffice(1));
  const auto poses = trackedPoses(file(kTracking));
  int without_pose = 0;
  auto clouds = read<sensor_msgs::PointCloud2>(kClouds, "/camera/rgb/points");
  clouds.erase(clouds.begin());
  for (const auto& cloud : clouds) {
    const auto pose = interpolated(poses, cloud.header.stamp.toSec());
    if (!pose) {
      ++without_pose;
      continue;
    }
    int near = 0;
    int count = 0;
    for (std::size_t i = 0; i < 60U * 80U; ++i) {
      float point[3];
      std::memcpy(point, cloud.data.data() + 32 * i, sizeof(point));
      if (std::isnan(point[2])) continue;
      const Vector3d reach = *pose * Vector3d(point[0], point[1], point[2]) - pose->translation();
      const auto hit = office.at(0.0).cast({pose->translation(), reach.normalized()}, 50.0);
      ++count;
      near += hit && std::abs(hit->distance - reach.norm()) < 6e-3 * reach.squaredNorm();
    }
    EXPECT_GT(near, count * 9 / 10);
  }
  EXPECT_EQ(without_pose, 1);
}

}  // namespace
}  // namespace pcrb_tools::simulation
