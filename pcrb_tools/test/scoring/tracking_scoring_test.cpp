#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "scoring/tracked_poses.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/own_log.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

constexpr std::uint32_t kScanCount = 20;

/// Where the sensor was, with turns and a speed that changes.
pcrb::Transform sensorAt(double s) {
  pcrb::Transform T = pcrb::Transform::Identity();
  T.linear() = Eigen::AngleAxisd(0.3 + 0.2 * s, Eigen::Vector3d(0.1, 0.2, 1).normalized())
                   .toRotationMatrix();
  T.translation() = Eigen::Vector3d(2 * s + std::sin(3 * s), std::cos(2 * s), 0.1 * s);
  return T;
}

double secondsOf(std::uint32_t k) { return 0.1 * k; }

std::string number(double value) { return ' ' + pcrb::formatShortest(value); }

/// The true poses in TUM's format, w last or first.
std::string tumText(double offset, bool w_first = false) {
  std::string text;
  for (std::uint32_t k = 0; k != kScanCount; ++k) {
    const pcrb::Transform T = sensorAt(secondsOf(k));
    const Eigen::Quaterniond q(T.linear());
    text += pcrb::formatFixed(1500000000.0 + secondsOf(k) - offset, 6);
    for (int i = 0; i != 3; ++i) text += number(T.translation()[i]);
    if (w_first) text += number(q.w());
    text += number(q.x()) + number(q.y()) + number(q.z());
    if (!w_first) text += number(q.w());
    text += '\n';
  }
  return text;
}

class TrackingScoring : public ::testing::Test {
 protected:
  TrackingScoring() {
    for (std::uint32_t k = 0; k != kScanCount; ++k) {
      pcrb::DatasetCloud cloud;
      cloud.viewpoint = sensorAt(secondsOf(k));
      for (const Eigen::Vector3d& point : {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-4, 0, 1)}) {
        cloud.points.emplace_back(cloud.viewpoint * point);
      }
      std::filesystem::create_directories(folder_.file("root/own/yard"));
      const auto stamp = pcrb::stampOf(pcrb_test::scanTime(k));
      pcrb::writePcd(folder_.file("root/own/yard/" + pcrb::formatStamp(stamp) + ".pcd"), cloud);
    }
    options_.folder = folder_.file("root/own/yard");
    options_.output = folder_.file("out");
  }

  std::string score(const std::string& text, const std::string& name = "poses.txt") {
    pcrb_test::writeFile(folder_.file(name), text);
    options_.poses.path = folder_.file(name);
    return score();
  }

  std::string score() {
    std::ostringstream out;
    runTrackingScoring(options_, out);
    return out.str();
  }

  /// That all scans have a pose, and no error to speak of.
  static void expectPerfect(const std::string& summary) {
    EXPECT_NE(summary.find("scans 20, with a pose 20;"), std::string::npos) << summary;
    std::istringstream rows(summary.substr(summary.find("APE translation m") + 17));
    double count = 0;
    double rmse = 1;
    rows >> count >> rmse;
    EXPECT_LT(rmse, 1e-4) << summary;
  }

  pcrb_test::TemporaryFolder folder_;
  TrackingOptions options_;
};

TEST_F(TrackingScoring, TakesEveryFormatOfTrajectories) {
  expectPerfect(score(tumText(0)));
  std::string kitti;
  std::string csv = "file,x,y,z,qw,qx,qy,qz\n";
  std::string euroc = "#timestamp, p_x, p_y, p_z, q_w, q_x, q_y, q_z\n";
  for (std::uint32_t k = 0; k != kScanCount; ++k) {
    const pcrb::Transform T = sensorAt(secondsOf(k));
    const Eigen::Quaterniond q(T.linear());
    std::string row;
    for (int i = 0; i != 12; ++i) row += number(T.matrix()(i / 4, i % 4));
    kitti += row.substr(1) + "\n";
    std::string pose;
    for (const double n : {T.translation().x(), T.translation().y(), T.translation().z(), q.w(),
                           q.x(), q.y(), q.z()}) {
      pose += "," + pcrb::formatShortest(n);
    }
    const auto stamp = pcrb::stampOf(pcrb_test::scanTime(k));
    csv += pcrb::formatStamp(stamp) + ".bin" + pose + "\n";
    euroc += std::to_string(stamp) + pose + "\n";
  }
  expectPerfect(score(kitti));
  expectPerfect(score(csv, "poses.csv"));
  expectPerfect(score(euroc, "euroc.csv"));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, score(kitti + kitti), "found a pose of scan 20");
}

TEST_F(TrackingScoring, TakesAFormatForWhatItIsSaidToBe) {
  options_.poses.format = pcrb::PoseFormat::kKitti;
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, score(tumText(0)),
                    "expected the 12 numbers of a matrix's first three rows");
  options_.poses.format = pcrb::PoseFormat::kTum;
  expectPerfect(score(tumText(0)));
}

TEST_F(TrackingScoring, TakesAPathAndTfOfABag) {
  options_.poses.path = folder_.file("run.bag");
  {
    rosbag::Bag bag(options_.poses.path, rosbag::bagmode::Write);
    nav_msgs::Path path;
    path.header = pcrb_test::header("map", kScanCount - 1);
    const pcrb::Transform T_odom_base = sensorAt(0).inverse();
    bag.write("/tf", pcrb_test::scanTime(0), pcrb_test::tfOf(sensorAt(0), "map", "odom", 0));
    for (std::uint32_t k = 0; k != kScanCount; ++k) {
      geometry_msgs::PoseStamped pose;
      pose.header = pcrb_test::header("map", k);
      pose.pose = pcrb::toMessage(sensorAt(secondsOf(k)));
      path.poses.push_back(pose);
      bag.write("/tf", pcrb_test::scanTime(k),
                pcrb_test::tfOf(T_odom_base * sensorAt(secondsOf(k)), "odom", "base_link", k));
    }
    bag.write("/path", pcrb_test::scanTime(kScanCount - 1), path);
  }
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, score(),
                    "found neither --topic nor --tf, expected where the poses are");
  options_.poses.topic = "/path";
  expectPerfect(score());
  options_.tf = {"map", "base_link"};
  expectPerfect(score());
  options_.tf = {"earth", "base_link"};
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, score(), "no way from `base_link` to `earth`");
}

TEST_F(TrackingScoring, AddsATimeOffsetAndEstimatesOne) {
  options_.time_offset = 0.25;
  expectPerfect(score(tumText(0.25)));
  options_.time_offset = 0.0;
  options_.largest_offset = 0.5;
  options_.max_difference = 0.06;
  const std::string summary = score(tumText(0.2));
  const std::string note = "note: time offset estimated: ";
  const std::size_t found = summary.find(note);
  ASSERT_NE(found, std::string::npos) << summary;
  EXPECT_NEAR(std::stod(summary.substr(found + note.size())), 0.2, 1e-5);
  expectPerfect(summary);
}

TEST_F(TrackingScoring, AMotionThatDoesNotChangeSaysNothingOfTime) {
  std::vector<pcrb::StampedPose> straight;
  for (std::uint32_t k = 0; k != kScanCount; ++k) {
    straight.push_back({k * pcrb::kSecond, pcrb::Transform(Eigen::Translation3d(k, 0, 0))});
  }
  PCRB_EXPECT_ERROR(
      pcrb::InvalidParameter,
      estimateTimeOffset(straight, pcrb::Trajectory(straight), pcrb::Transform::Identity(), 2.0),
      "found no time offset within 2 s that fits better than others");
}

TEST_F(TrackingScoring, SuspectsTheOrderOfQuaternions) {
  EXPECT_NE(score(tumText(0, true)).find("note: the orientations are right if w is read first"),
            std::string::npos);
  EXPECT_EQ(score(tumText(0)).find("note:"), std::string::npos);
}

TEST_F(TrackingScoring, SaysWhyNoScanHasAPose) {
  PCRB_EXPECT_ERROR(pcrb::InvalidParameter, score(tumText(7200)),
                    "found a pose for none of 20 scans (scans from 1500000000.000 to "
                    "1500000001.900 s, poses from 1499992800.000 to 1499992801.900 s; the nearest "
                    "pose is 7198.100000 s from a scan: do the clocks differ?");
}

TEST_F(TrackingScoring, TheLastOfTwoPosesOfAScanCounts) {
  const std::string summary = score("1500000000.0 9 9 9 0 0 0 1\n" + tumText(0));
  expectPerfect(summary);
  EXPECT_NE(summary.find("note: 1 poses have the stamp of a later one, or its scan"),
            std::string::npos);
}

}  // namespace
}  // namespace pcrb_tools
