#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>

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
using pcrb_test::OwnBagWriter;
using pcrb_test::sensorInBody;

class OwnBagConversion : public testing::Test {
 protected:
  OwnRequest request() const {
    OwnRequest request;
    request.inputs = {bag_};
    request.root = folder_.file("root");
    request.data_set = "mine";
    return request;
  }

  pcrb::DatasetCloud cloud(std::uint32_t k) const {
    return pcrb::readPcd(folder_.file("root/mine/drive/150000000" + std::to_string(k / 10) + "." +
                                      std::to_string(k % 10) + "00000000.pcd"));
  }

  /// The scan's points, moved by hand.
  void expectPlaced(std::uint32_t k, const pcrb::Transform& T_world_sensor) const {
    const pcrb::DatasetCloud found = cloud(k);
    const auto& points = pcrb_test::scanPoints();
    ASSERT_EQ(found.points.size(), points.size() / 3);
    for (std::size_t i = 0; i != found.points.size(); ++i) {
      const Eigen::Vector3d point(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      EXPECT_LT((found.points[i] - T_world_sensor * point).norm(), 1e-9);
    }
    EXPECT_LT((found.viewpoint.matrix() - T_world_sensor.matrix()).norm(), 1e-9);
  }

  pcrb_test::TemporaryFolder folder_;
  std::string bag_ = folder_.file("drive.bag");
};

TEST_F(OwnBagConversion, FindsCloudsOdometryAndExtrinsicsWhereThereIsOneOfEach) {
  OwnBagWriter(bag_).addOdometry().addExtrinsics();
  const ConversionReport report = convertOwn(request());
  EXPECT_EQ(report.sequence, "drive");
  EXPECT_EQ(report.written.size(), 4u);
  for (std::uint32_t k = 0; k != 4; ++k) expectPlaced(k, bodyAt(k) * sensorInBody());
}

TEST_F(OwnBagConversion, FindsPosesOnTfFromTheRootOfTheCloudsFrame) {
  OwnBagWriter(bag_).addTf().addExtrinsics();
  convertOwn(request());
  expectPlaced(2, bodyAt(2) * sensorInBody());
}

TEST_F(OwnBagConversion, AnOffsetMovesTheTimesOfPosesOnTfToo) {
  OwnBagWriter(bag_).addTf().addExtrinsics();
  OwnRequest late = request();
  late.time_offset = 0.1;  // the pose of scan k has the stamp of scan k - 1
  convertOwn(late);
  expectPlaced(2, bodyAt(1) * sensorInBody());
}

TEST_F(OwnBagConversion, TakesPosesWithoutABodyAsThoseOfTheCloudsAndSaysSo) {
  {
    OwnBagWriter writer(bag_);
    for (std::uint32_t k = 0; k != 4; ++k) writer.add("/gt", k, pcrb_test::poseAt(k));
    writer.addExtrinsics();
  }
  const ConversionReport report = convertOwn(request());
  expectPlaced(1, bodyAt(1));
  EXPECT_NE(formatReport(report).find("taken as those of `velodyne`"), std::string::npos);
  OwnRequest with_body = request();
  with_body.body_frame = "base_link";
  convertOwn(with_body);
  expectPlaced(1, bodyAt(1) * sensorInBody());
  OwnRequest with_extrinsics = request();
  with_extrinsics.T_body_sensor = pcrb::Transform(Eigen::Translation3d(1, 0, 0));
  convertOwn(with_extrinsics);
  expectPlaced(1, bodyAt(1) * *with_extrinsics.T_body_sensor);
}

TEST_F(OwnBagConversion, ReadsAPathAndAPoseWithCovariance) {
  {
    OwnBagWriter writer(bag_);
    nav_msgs::Path path;
    path.header = pcrb_test::header("map", 3);
    for (std::uint32_t k = 0; k != 4; ++k) {
      path.poses.push_back(pcrb_test::poseAt(k));
      geometry_msgs::PoseWithCovarianceStamped pose;
      pose.header = pcrb_test::header("map", k);
      pose.pose.pose = pcrb::toMessage(bodyAt(k + 1));
      writer.add("/estimate", k, pose);
    }
    writer.add("/path", 3, path);
  }
  convertOwn(request());  // a path repeats what is elsewhere
  expectPlaced(1, bodyAt(2));
  OwnRequest by_path = request();
  by_path.pose_topic = "/path";
  convertOwn(by_path);
  expectPlaced(1, bodyAt(1));
}

TEST_F(OwnBagConversion, InterpolatesUpToTheLargestGap) {
  {
    OwnBagWriter writer(bag_, 3);
    writer.add("/odom", 0, pcrb_test::odometryAt(0)).add("/odom", 2, pcrb_test::odometryAt(2));
    writer.addExtrinsics();
  }
  convertOwn(request());
  expectPlaced(1, bodyAt(1) * sensorInBody());
  OwnRequest strict = request();
  strict.max_gap = pcrb::kSecond / 10;
  const ConversionReport report = convertOwn(strict);
  EXPECT_EQ(report.written.size(), 2u);
  EXPECT_EQ(report.dropped.at("in a gap of the poses").size(), 1u);
}

TEST_F(OwnBagConversion, ThinsByDistanceAndTime) {
  OwnBagWriter(bag_, 10).addOdometry(10).addExtrinsics();
  OwnRequest far = request();
  far.min_distance = 1.2;  // 0.5 m between scans
  EXPECT_EQ(convertOwn(far).written.size(), 4u);
  OwnRequest slow = request();
  slow.max_rate = 5.0;
  EXPECT_EQ(convertOwn(slow).written.size(), 5u);
}

TEST_F(OwnBagConversion, CloudsInTheFrameOfThePosesAreNotMoved) {
  {
    rosbag::Bag bag(bag_, rosbag::bagmode::Write);
    for (std::uint32_t k = 0; k != 2; ++k) {
      const ros::Time time = pcrb_test::scanTime(k);
      bag.write("/scan", time,
                pcrb_test::makeCloud(pcrb_test::header("map", k), pcrb_test::scanPoints()));
      bag.write("/sensor", time, pcrb_test::poseAt(k));
    }
    const pcrb::Transform origin(Eigen::Translation3d(4e5, 4e6, 0));
    bag.write("/tf_static", pcrb_test::scanTime(0), pcrb_test::tfOf(origin, "earth", "map", 0));
  }
  convertOwn(request());
  EXPECT_LT((cloud(1).points[0] - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((cloud(1).viewpoint.matrix() - bodyAt(1).matrix()).norm(), 1e-12);
  OwnRequest in_earth = request();
  in_earth.world_frame = "earth";
  convertOwn(in_earth);
  EXPECT_LT((cloud(1).points[0] - Eigen::Vector3d(400001, 4000002, 3)).norm(), 1e-9);
  EXPECT_EQ(cloud(1).viewpoint.translation().x(), 400000.5);
}

TEST_F(OwnBagConversion, ListsWhatThereIsWhereMoreThanOneThingCouldBeMeant) {
  OwnBagWriter(bag_).addOdometry().addTf().addExtrinsics().add(
      "/map", 0, pcrb_test::makeCloud(pcrb_test::header("map", 0), {1, 2, 3}));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()),
                    "found clouds on /map, /velodyne_points, expected one topic of "
                    "sensor_msgs/PointCloud2 (--cloud-topic chooses)");
  OwnRequest chosen = request();
  chosen.cloud_topic = "/velodyne_points";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(chosen),
                    "found poses on /odom, tf of map > velodyne, expected one source of poses");
  chosen.pose_topic = "/odom";
  convertOwn(chosen);
  expectPlaced(3, bodyAt(3) * sensorInBody());
  chosen.pose_topic.clear();
  chosen.tf = {"map", "base_link"};
  convertOwn(chosen);
  expectPlaced(3, bodyAt(3) * sensorInBody());
  chosen.cloud_topic = "/points";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(chosen),
                    "found no message on /points among the topics /map (sensor_msgs/PointCloud2) "
                    "/odom (nav_msgs/Odometry)");
  chosen = request();
  chosen.cloud_topic = "/velodyne_points";
  chosen.pose_topic = "/velodyne_points";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(chosen), "expected geometry_msgs PoseStamped");
}

TEST_F(OwnBagConversion, NamesTheFramesThatExtrinsicsAreMissingBetween) {
  OwnBagWriter(bag_).addOdometry();
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(request()),
                    "no fixed transform from the clouds' frame `velodyne` to that of the poses, "
                    "`base_link`, among no transform on /tf or /tf_static, expected it on tf, or "
                    "--sensor-in-body");
}

TEST_F(OwnBagConversion, SaysWhyNoScanHasAPose) {
  OwnBagWriter(bag_).addExtrinsics();
  pcrb_test::writeFile(folder_.file("poses.txt"),
                       "1500003600 0 0 0 0 0 0 1\n1500003601 0 0 0 0 0 0 1\n");
  OwnRequest late = request();
  late.poses = folder_.file("poses.txt");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(late),
                    "no pose: scans from 1500000000.000 to 1500000000.300 s, poses from "
                    "1500003600.000 to 1500003601.000 s; the nearest pose is 3599.700000 s from a "
                    "scan: do the clocks differ?");
  late.time_offset = -3600;
  late.max_gap = pcrb::kSecond;
  EXPECT_EQ(convertOwn(late).written.size(), 4u);
}

TEST_F(OwnBagConversion, MovesTheTimeOfTfAndOfATopicAlike) {
  OwnBagWriter(bag_).addTf().addOdometry().addExtrinsics();
  OwnRequest late = request();
  late.time_offset = 0.1;  // a scan has the pose that was recorded for the one before
  late.tf = {"map", "base_link"};
  EXPECT_EQ(convertOwn(late).written.size(), 3u);
  expectPlaced(2, bodyAt(1) * sensorInBody());
  late.tf.clear();
  late.pose_topic = "/odom";
  convertOwn(late);
  expectPlaced(2, bodyAt(1) * sensorInBody());
  late.times = "times.txt";
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, convertOwn(late),
                    "--times: found bags, expected files of clouds");
}

TEST_F(OwnBagConversion, DropsACloudOfNoPoints) {
  OwnBagWriter(bag_).addOdometry().addExtrinsics().add("/velodyne_points", 5, [] {
    sensor_msgs::PointCloud2 empty;
    empty.header = pcrb_test::header("velodyne", 0);
    empty.header.stamp += ros::Duration(0.05);
    return empty;
  }());
  const ConversionReport report = convertOwn(request());
  EXPECT_EQ(report.written.size(), 4u);
  EXPECT_EQ(report.scans_read, 5u);
}

TEST_F(OwnBagConversion, DeskewsPointsByTheirTimes) {
  {
    rosbag::Bag bag(bag_, rosbag::bagmode::Write);
    pcrb_test::CloudLayout layout;
    layout.color = "time";  // at offset 16
    auto cloud =
        pcrb_test::makeCloud(pcrb_test::header("base_link", 0), {1, 2, 3, 1, 2, 3}, layout);
    for (std::size_t i = 0; i != 2; ++i) {
      const float time = i == 0 ? 0.0F : 0.1F;
      std::memcpy(&cloud.data[i * 32 + 16], &time, sizeof(time));
    }
    bag.write("/points", pcrb_test::scanTime(0), cloud);
    for (std::uint32_t k = 0; k != 3; ++k) {
      bag.write("/odom", pcrb_test::scanTime(k), pcrb_test::odometryAt(k));
    }
  }
  OwnRequest deskewed = request();
  deskewed.deskew = true;
  convertOwn(deskewed);
  const Eigen::Vector3d point(1, 2, 3);
  EXPECT_LT((cloud(0).points[0] - bodyAt(0) * point).norm(), 1e-6);
  EXPECT_LT((cloud(0).points[1] - bodyAt(1) * point).norm(), 1e-6);
  convertOwn(request());
  EXPECT_LT((cloud(0).points[1] - bodyAt(0) * point).norm(), 1e-6);
}

TEST_F(OwnBagConversion, RefusesToDeskewCloudsWithoutTimes) {
  OwnBagWriter(bag_).addOdometry().addExtrinsics();
  OwnRequest deskewed = request();
  deskewed.deskew = true;
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertOwn(deskewed),
                    "points without a field of their times");
}

}  // namespace
}  // namespace pcrb_tools
