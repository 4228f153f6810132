#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "conversion/converters.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "support/bag_writer.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/png_writer.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using pcrb_test::headerAt;
using pcrb_test::makeCloud;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr const char* kTopic = "/camera/rgb/points";
constexpr const char* kFrame = "/openni_rgb_optical_frame";
constexpr const char* kLogName = "rgbd_dataset_freiburg2_pioneer_slam";

/// Quarter turn about z over 0.1 s, with a sign flip of the quaternion; then a gap.
const char* const kPoses =
    "# timestamp tx ty tz qx qy qz qw\n"
    "1311878220.3 1 2 3 0 0 0 1\n"
    "1311878220.4 2 2 3 0 0 -0.70710678118654752 -0.70710678118654752\n"
    "1311878230.0 5 2 3 0 0 0 1\n";

constexpr std::uint32_t kSecond = 1311878220;
constexpr std::uint32_t kNano = 377686160;

/// x y z of the world for a point at kSecond.kNano, computed from the numbers above alone.
Eigen::Vector3d naiveWorld(double x, double y, double z) {
  const double share = 0.77686160;
  const double angle = share * M_PI / 2;
  return {std::cos(angle) * x - std::sin(angle) * y + 1 + share,
          std::sin(angle) * x + std::cos(angle) * y + 2, z + 3};
}

class TumConversion : public testing::Test {
 protected:
  TumConversion() {
    pcrb_test::writeFile(folder_.file(std::string(kLogName) + "-groundtruth.txt"), kPoses);
  }

  TumRequest request(const std::string& input) const {
    TumRequest request;
    request.inputs = {input};
    request.root = folder_.file("root");
    return request;
  }

  std::string bag(const std::string& suffix = "-2hz-with-pointclouds") const {
    return folder_.file(kLogName + suffix + ".bag");
  }

  pcrb::DatasetCloud cloud(const std::string& stamp = "1311878220.377686160") const {
    return pcrb::readPcd(folder_.file("root/tum/pioneer_slam/" + stamp + ".pcd"));
  }

  void expectPoint(const pcrb::DatasetCloud& cloud, std::size_t i, double x, double y,
                   double z) const {
    ASSERT_LT(i, cloud.points.size());
    EXPECT_LT((cloud.points[i] - naiveWorld(x, y, z)).norm(), 1e-6);
  }

  pcrb_test::TemporaryFolder folder_;
};

TEST_F(TumConversion, CloudsOfABagArePlacedByTheInterpolatedPoseAndNamedByTheirStamp) {
  pcrb_test::BagWriter(bag()).add(
      kTopic, makeCloud(headerAt(kSecond, kNano, kFrame),
                        {0.5f, 0.25f, 2.f, kNaN, kNaN, kNaN, -1.f, 3.f, 4.f, 1.f, 1.f, 1.f},
                        {0, 32, 2, 64, "rgb"}));
  const ConversionReport report = convertTum(request(bag()));
  EXPECT_EQ(report.sequence, "pioneer_slam");
  EXPECT_EQ(report.written, std::set<std::string>{"1311878220.377686160.pcd"});
  EXPECT_EQ(report.points.read, 4u);
  EXPECT_EQ(report.points.non_finite, 1u);
  const auto result = cloud();
  expectPoint(result, 0, 0.5, 0.25, 2.0);
  expectPoint(result, 1, -1.0, 3.0, 4.0);
  EXPECT_LT((result.viewpoint.translation() - naiveWorld(0, 0, 0)).norm(), 1e-9);
}

TEST_F(TumConversion, PosesMayComeInAnotherFormatOfTrajectories) {
  pcrb_test::BagWriter(bag()).add(kTopic,
                                  makeCloud(headerAt(kSecond, kNano, kFrame), {0.5f, 0.25f, 2.f}));
  TumRequest other = request(bag());
  other.poses = folder_.file("truth.csv");  // EuRoC's
  pcrb_test::writeFile(other.poses,
                       "#timestamp, p_x, p_y, p_z, q_w, q_x, q_y, q_z\n"
                       "1311878220300000000,1,2,3,1,0,0,0\n"
                       "1311878220400000000,2,2,3,0.70710678118654752,0,0,0.70710678118654752\n");
  convertTum(other);
  expectPoint(cloud(), 0, 0.5, 0.25, 2.0);
  pcrb_test::writeFile(other.poses, "1 0 0 1 0 1 0 2 0 0 1 3\n");  // KITTI's
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(other),
                    "truth.csv: found poses without timestamps (kitti), expected timestamps");
}

TEST_F(TumConversion, FieldsAreFoundByNameWhateverHeightAndRowStepSay) {
  pcrb_test::BagWriter(bag()).add(
      kTopic, makeCloud(headerAt(kSecond, kNano, kFrame), {0.5f, 0.25f, 2.f, -1.f, 3.f, 4.f},
                        {8, 48, 1, 0, "rgb"}));
  convertTum(request(bag()));
  expectPoint(cloud(), 0, 0.5, 0.25, 2.0);
  expectPoint(cloud(), 1, -1.0, 3.0, 4.0);
}

TEST_F(TumConversion, CloudsWithoutColourOrPoseAreDroppedAndReported) {
  pcrb_test::BagWriter(bag())
      .add(kTopic, makeCloud(headerAt(kSecond - 5, 0, kFrame), {1.f, 1.f, 1.f}))
      .add(kTopic,
           makeCloud(headerAt(kSecond, 350000000, kFrame), {1.f, 1.f, 1.f}, {0, 16, 1, 0, ""}))
      .add(kTopic, makeCloud(headerAt(kSecond, kNano, kFrame), {0.5f, 0.25f, 2.f}))
      .add(kTopic, makeCloud(headerAt(kSecond + 3, 0, kFrame), {1.f, 1.f, 1.f}))
      .add(kTopic, makeCloud(headerAt(kSecond + 20, 0, kFrame), {1.f, 1.f, 1.f}));
  const ConversionReport report = convertTum(request(bag()));
  EXPECT_EQ(report.scans_read, 5u);
  EXPECT_EQ(report.written.size(), 1u);
  const auto dropped = [&report](const std::string& reason) {
    const auto found = report.dropped.find(reason);
    return found == report.dropped.end() ? 0 : found->second.size();
  };
  EXPECT_EQ(dropped("before the first pose"), 1u);
  EXPECT_EQ(dropped("without colour"), 1u);
  EXPECT_EQ(dropped("in a gap of the poses"), 1u);
  EXPECT_EQ(dropped("after the last pose"), 1u);
}

TEST_F(TumConversion, PointsThatAreNotFiniteAreLeftOutWhateverIsDenseSays) {
  auto cloud = makeCloud(headerAt(kSecond, kNano, kFrame), {NAN, 1.f, 1.f, 0.5f, 0.25f, 2.f});
  cloud.is_dense = true;
  pcrb_test::BagWriter(bag()).add(kTopic, cloud);
  const ConversionReport report = convertTum(request(bag()));
  EXPECT_EQ(report.points.non_finite, 1u);
  EXPECT_EQ(report.points.written(), 1u);
}

TEST_F(TumConversion, CloudsThatAProblemFileNamesAndConversionRefusedAreListed) {
  pcrb_test::BagWriter(bag())
      .add(kTopic, makeCloud(headerAt(kSecond, kNano, kFrame), {0.5f, 0.25f, 2.f}))
      .add(kTopic, makeCloud(headerAt(kSecond + 3, 0, kFrame), {1.f, 1.f, 1.f}));
  pcrb_test::writeFile(folder_.file("root/tum/pioneer_slam_local.txt"),
                       "id source target overlap t1 t2 t3 t4 t5 t6 t7 t8 t9 t10 t11 t12\n"
                       "123456789000 1311878220.377686160.pcd 1311878223.000000000.pcd 0.5 "
                       "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const TumRequest asked = request(bag());
  const auto lines = describeMissingClouds(asked, convertTum(asked));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("pioneer_slam_local.txt names 1311878223.000000000.pcd"),
            std::string::npos);
}

TEST_F(TumConversion, NearestReproducesUpstreamWithoutALimit) {
  pcrb_test::BagWriter(bag())
      .add(kTopic, makeCloud(headerAt(kSecond, kNano, kFrame), {1.f, 0.f, 0.f}))
      .add(kTopic, makeCloud(headerAt(kSecond + 20, 0, kFrame), {1.f, 0.f, 0.f}));
  TumRequest nearest = request(bag());
  nearest.options.nearest = true;
  EXPECT_EQ(convertTum(nearest).written.size(), 2u);
  EXPECT_LT((cloud().points.at(0) - Eigen::Vector3d(2, 3, 3)).norm(), 1e-6);
  EXPECT_LT((cloud("1311878240.000000000").points.at(0) - Eigen::Vector3d(6, 2, 3)).norm(), 1e-6);
}

TEST_F(TumConversion, TheGapLimitIsAParameter) {
  pcrb_test::BagWriter(bag()).add(kTopic,
                                  makeCloud(headerAt(kSecond + 3, 0, kFrame), {1.f, 1.f, 1.f}));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag())), "no scan became a cloud");
  TumRequest patient = request(bag());
  patient.options.max_gap = 10 * pcrb::kSecond;
  EXPECT_EQ(convertTum(patient).written.size(), 1u);
}

TEST_F(TumConversion, AStreamOfThirtyHertzIsThinnedToTwo) {
  std::string poses;
  for (int i = 0; i <= 310; ++i) {
    poses += pcrb::formatStamp(kSecond * pcrb::kSecond + i * 10000000LL) + " 0 0 0 0 0 0 1\n";
  }
  pcrb_test::writeFile(folder_.file("dense.txt"), poses);
  {
    pcrb_test::BagWriter writer(bag());
    for (std::uint32_t i = 0; i < 87; ++i) {
      const std::uint32_t nano = i * 33333333U;
      const auto header = headerAt(kSecond + nano / 1000000000U, nano % 1000000000U, kFrame);
      writer.add(kTopic, makeCloud(header, {1.f, 1.f, 1.f}));
    }
  }
  TumRequest thinned = request(bag());
  thinned.poses = folder_.file("dense.txt");
  thinned.options.max_rate = 2.0;
  ConversionReport report = convertTum(thinned);
  EXPECT_EQ(report.written.size(), 6u);  // 3 s
  EXPECT_EQ(report.dropped.at("beyond the maximal rate").size(), 81u);
  thinned.options.max_rate.reset();  // all clouds of a bag
  report = convertTum(thinned);
  EXPECT_EQ(report.written.size(), 87u);
  EXPECT_EQ(report.scans_kept, 6u);
}

TEST_F(TumConversion, DepthImagesOfARawBagBecomeCloudsByTheirCamera) {
  const auto header = headerAt(kSecond, kNano, kFrame);
  pcrb_test::BagWriter(bag(""))
      .add("/camera/rgb/camera_info", pcrb_test::makeCamera(header, 500.0, 0.5))
      .add("/camera/depth/image", pcrb_test::makeDepth<float>(header, 2, {1.5f, kNaN, 0.f, 3.f}));
  const ConversionReport report = convertTum(request(bag("")));
  EXPECT_EQ(report.points.read, 4u);
  EXPECT_EQ(report.points.non_finite, 2u);
  expectPoint(cloud(), 0, -0.5 * 1.5 / 500, -0.5 * 1.5 / 500, 1.5);
  expectPoint(cloud(), 1, 0.5 * 3 / 500, 0.5 * 3 / 500, 3.0);
}

TEST_F(TumConversion, DepthImagesOfSixteenBitsAreMillimetresAndPngsFiveThousandthsOfAMetre) {
  const auto header = headerAt(kSecond, kNano, kFrame);
  pcrb_test::BagWriter(bag(""))
      .add("/camera/rgb/camera_info", pcrb_test::makeCamera(header, 525.0, 0.5))
      .add("/camera/depth/image",
           pcrb_test::makeDepth<std::uint16_t>(header, 2, {1500, 0, 0, 3000}));
  convertTum(request(bag("")));
  const auto from_bag = cloud();
  expectPoint(from_bag, 0, -0.5 * 1.5 / 525, -0.5 * 1.5 / 525, 1.5);
  TumRequest camera = request(folder_.file(std::string(kLogName) + ".tgz"));
  camera.options.intrinsics = pcrb::Intrinsics{525.0, 525.0, 0.5, 0.5};
  const std::string png = pcrb_test::makePng(2, 2, {7500, 0, 0, 15000});
  const std::string inside = std::string(kLogName) + "/";
  pcrb_test::writeArchive(camera.inputs[0], {{inside + "depth/1.png", png},
                                             {inside + "depth.txt",
                                              "# depth maps\n1311878220.377686160 depth/1.png\n"
                                              "1311878220.39 depth/gone.png\n"},
                                             {inside + "groundtruth.txt", kPoses}});
  const ConversionReport report = convertTum(camera);
  EXPECT_EQ(report.sequence, "pioneer_slam");
  EXPECT_EQ(report.dropped.at("listed, but without a file").size(), 1u);
  ASSERT_EQ(cloud().points.size(), from_bag.points.size());
  for (std::size_t i = 0; i != from_bag.points.size(); ++i) {
    EXPECT_LT((cloud().points[i] - from_bag.points[i]).norm(), 1e-12);
  }
}

TEST_F(TumConversion, ACameraThatWouldChangeThePointsIsRefused) {
  const auto header = headerAt(kSecond, kNano, kFrame);
  auto distorted = pcrb_test::makeCamera(header, 525.0, 0.5);
  distorted.D[0] = 0.1;
  const auto image = pcrb_test::makeDepth<float>(header, 1, {1.f});
  pcrb_test::BagWriter(bag(""))
      .add("/camera/rgb/camera_info", distorted)
      .add("/camera/depth/image", image);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag(""))), "a camera with distortion");
  pcrb_test::BagWriter(bag("")).add("/camera/depth/image", image);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag(""))),
                    "/camera/rgb/camera_info: found no message");
  pcrb_test::BagWriter(bag(""))
      .add("/camera/rgb/camera_info", pcrb_test::makeCamera(header, 525.0, 0.5))
      .add("/camera/rgb/camera_info", pcrb_test::makeCamera(header, 526.0, 0.5))
      .add("/camera/depth/image", image);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag(""))), "found two cameras");
}

TEST_F(TumConversion, MessagesThatDoNotHoldWhatTheySayAreErrors) {
  auto cut = makeCloud(headerAt(kSecond, kNano, kFrame), {1.f, 1.f, 1.f});
  cut.width = 2;
  pcrb_test::BagWriter(bag()).add(kTopic, cut);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag())),
                    "/camera/rgb/points 1311878220.377686160.pcd: PointCloud2: found 32 bytes");
  auto colour = pcrb_test::makeDepth<float>(headerAt(kSecond, kNano, kFrame), 1, {1.f});
  colour.encoding = "rgb8";
  pcrb_test::BagWriter(bag(""))
      .add("/camera/rgb/camera_info", pcrb_test::makeCamera(colour.header, 525.0, 0.5))
      .add("/camera/depth/image", colour);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag(""))), "encoding 'rgb8'");
  pcrb_test::BagWriter(bag()).add(kTopic, colour);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag())),
                    "topic /camera/rgb/points: found sensor_msgs/Image");
  for (const auto& name : pcrb_test::namesIn(folder_.file("root/tum/pioneer_slam"))) {
    EXPECT_EQ(name, ".conversion");
  }
}

TEST_F(TumConversion, ABrokenBagAndMissingPosesAreErrors) {
  pcrb_test::writeFile(bag(), "#ROSBAG V2.0\nnothing more");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag())), bag());
  pcrb_test::BagWriter(bag()).add(kTopic, makeCloud(headerAt(kSecond, kNano, kFrame), {1, 1, 1}));
  fs::resize_file(bag(), fs::file_size(bag()) / 2);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag())), bag());
  pcrb_test::BagWriter(bag()).add("/tf", pcrb_test::makeCamera(headerAt(1, 1, ""), 1, 1));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag())), "found no message on");
  fs::remove(folder_.file(std::string(kLogName) + "-groundtruth.txt"));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(bag())), "--poses");
}

TEST_F(TumConversion, ADamagedPngNamesItsFile) {
  const std::string log = folder_.file(kLogName);
  pcrb_test::writeFiles(log, {{"depth/1.png", "<html>"},
                              {"depth.txt", "1311878220.377686160 depth/1.png\n"},
                              {"groundtruth.txt", kPoses}});
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertTum(request(log)), "depth/1.png: no depth image");
}

TEST_F(TumConversion, RealDepthImagesAndGroundTruthBecomeClouds) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string data = pcrb_test::sharedData() + "/tum/";
  const std::string log = folder_.file("rgbd_dataset_freiburg2_desk");
  pcrb_test::writeFiles(log, {{"depth.txt",
                               "1311868164.9 depth/1_depth.png\n"
                               "1311868200.0 depth/2_depth.png\n"}});
  fs::create_directories(log + "/depth");
  fs::copy_file(data + "1_depth.png", log + "/depth/1_depth.png");
  fs::copy_file(data + "2_depth.png", log + "/depth/2_depth.png");
  fs::copy_file(data + "fr2_desk_groundtruth.txt", log + "/groundtruth.txt");
  const ConversionReport report = convertTum(request(log));
  EXPECT_EQ(report.written, std::set<std::string>{"1311868164.900000000.pcd"});
  EXPECT_EQ(report.dropped.at("in a gap of the poses").size(), 1u);
  EXPECT_GT(report.points.written(), 100000u);
  EXPECT_NE(formatReport(report).find("1 poses have the stamp of a later one"), std::string::npos);
}

}  // namespace
}  // namespace pcrb_tools
