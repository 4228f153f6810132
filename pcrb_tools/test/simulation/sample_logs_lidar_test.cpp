#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <regex>
#include <set>

#include "pcrb_core/point_cloud.hpp"
#include "simulation/props.hpp"
#include "support/sample_log_support.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;
using pcrb_test::makeLogs;
using pcrb_test::numbersOf;
using pcrb_test::readLines;
using pcrb_test::readText;
using pcrb_test::TemporaryFolder;
using pcrb_test::tinyLogs;

Vector3d pointOf(const std::vector<double>& row, std::size_t first) {
  return {row.at(first), row.at(first + 1), row.at(first + 2)};
}

/// Rows of a 4 × 4 or 3 × 4 matrix from a place in a list of numbers on.
pcrb::Transform poseOf(const std::vector<double>& numbers, std::size_t first) {
  pcrb::Transform pose = pcrb::Transform::Identity();
  for (int i = 0; i < 12; ++i)
    pose.matrix()(i / 4, i % 4) = numbers.at(first + static_cast<std::size_t>(i));
  return pose;
}

/// A point in the world and when it was measured, s since the start of the log.
struct TimedPoint {
  Vector3d position;
  double time = 0.0;
};

/// Share of points whose ray from the sensor ends within `tolerance` m of them on the scene.
double shareOnSurfaces(const Scene& scene, const pcrb::Transform& T_world_sensor,
                       const std::vector<TimedPoint>& points, double tolerance) {
  double on_surface = 0.0;
  for (const TimedPoint& point : points) {
    const Vector3d reach = point.position - T_world_sensor.translation();
    const auto hit =
        scene.at(point.time).cast({T_world_sensor.translation(), reach.normalized()}, 100.0);
    if (hit && std::abs(hit->distance - reach.norm()) < tolerance) on_surface += 1.0;
  }
  return on_surface / static_cast<double>(points.size());
}

class LidarLogs : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    makeLogs(planEthLogs(tinyLogs()), folder_->path());
    makeLogs(planPlanetaryLogs(tinyLogs()), folder_->path());
    makeLogs(planKaistLogs(tinyLogs()), folder_->path());
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string file(const std::string& name) { return folder_->file(name); }

  static TemporaryFolder* folder_;
};
TemporaryFolder* LidarLogs::folder_ = nullptr;

TEST_F(LidarLogs, EthHeadersVaryAsTheArchivesDo) {
  const auto start = [](const std::string& name) {
    const std::string text = readText(file(name));
    return text.substr(0, text.find('\n') + 1);
  };
  EXPECT_EQ(start("eth/apartment/csv_global/PointCloud0.csv"),
            "Time_in_sec, x, y, z, Intensities, 2DscanId, PointId\n");
  EXPECT_EQ(start("eth/apartment/csv_local/Hokuyo_0.csv"),
            "Time_in_sec,x,y,z,Intensities,2DscanId,PointId\n");
  EXPECT_EQ(start("eth/wood_summer/csv_global/PointCloud1.csv"),
            "Time_in_sec,x,y,z,Intensities,2DscanId,Points\n");
  EXPECT_EQ(start("eth/wood_summer/csv_local/Hokuyo_1.csv"),
            "\"Time_in_sec\",\"x\",\"y\",\"z\",\"Intensities\",\"2DscanId\",\"PointId\"\r\n");
}

TEST_F(LidarLogs, EthRowsAreSpelledAsTheSensorsSoftwareDoes) {
  const std::string number = "-?[0-9]+\\.[0-9]{8}";
  const std::regex apartment("132293599[0-9]\\.[0-9]{6}," + number + "," + number + "," + number +
                             ",-1,[0-9]+,[0-9]+");
  const std::regex wood("13142700[0-9]{2}\\.[0-9]{6}," + number + "," + number + "," + number +
                        ",[0-9]+,[0-9]+\\.000000,[0-9]+\\.000000");
  EXPECT_TRUE(std::regex_match(readLines(file("eth/apartment/csv_global/PointCloud0.csv")).at(5),
                               apartment));
  EXPECT_TRUE(
      std::regex_match(readLines(file("eth/wood_summer/csv_global/PointCloud0.csv")).at(5), wood));
}

TEST_F(LidarLogs, EthGlobalIsLocalMovedByTheLeicaPose) {
  for (const std::string sequence : {"apartment", "wood_summer"}) {
    const std::string poses = sequence == "apartment" ? "leica" : "csv_global";
    const auto pose_rows =
        readLines(file("eth/" + sequence + "/" + poses + "/pose_scanner_leica.csv"));
    ASSERT_EQ(pose_rows.size(), 3U);
    EXPECT_EQ(pose_rows[0].substr(0, 27), "poseId, timestamp, T00, T01");
    for (const int scan : {0, 1}) {
      const auto numbers = numbersOf(pose_rows[static_cast<std::size_t>(scan) + 1]);
      ASSERT_EQ(numbers.size(), 18U);
      EXPECT_EQ(numbers[0], scan);
      EXPECT_EQ(numbers[17], 1.0);
      const pcrb::Transform T_world_scanner = poseOf(numbers, 2);
      const std::string index = std::to_string(scan);
      const auto global =
          readLines(file("eth/" + sequence + "/csv_global/PointCloud" + index + ".csv"));
      const auto local = readLines(file("eth/" + sequence + "/csv_local/Hokuyo_" + index + ".csv"));
      ASSERT_EQ(global.size(), local.size());
      for (std::size_t i = 1; i < global.size(); ++i) {
        const Vector3d expected = T_world_scanner * pointOf(numbersOf(local[i]), 1);
        ASSERT_LT((pointOf(numbersOf(global[i]), 1) - expected).norm(), 3e-8);
      }
    }
  }
}

TEST_F(LidarLogs, EthPointsLieOnTheApartmentAndWhoWalksThere) {
  const auto poses = readLines(file("eth/apartment/leica/pose_scanner_leica.csv"));
  const auto rows = readLines(file("eth/apartment/csv_global/PointCloud0.csv"));
  EXPECT_GT(rows.size(), 24U * 60U * 3 / 4);
  EXPECT_LE(rows.size(), 24U * 60U + 1);
  const auto pose = numbersOf(poses.at(1));
  std::vector<TimedPoint> points;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto row = numbersOf(rows[i]);
    points.push_back({pointOf(row, 1), row[0] - pose[1]});
  }
  const Scene apartment(describeApartment(1));
  EXPECT_GT(shareOnSurfaces(apartment, poseOf(pose, 2), points, 0.05), 0.95);
}

TEST_F(LidarLogs, PlanetaryFilesAreSpelledAsPublished) {
  const std::string number = "-?[0-9]+\\.[0-9]{6}";
  const std::regex point(number + " " + number + " " + number);
  const std::regex row(number + " " + number + " " + number + " " + number);
  for (const std::string set : {"box_met", "p2at_met"}) {
    const std::string scan = "planetary/" + set + "/" + set + "_001/" + set + "_001";
    for (const std::string& line : readLines(file(scan + ".xyz")))
      ASSERT_TRUE(std::regex_match(line, point)) << line;
    const auto lines = readLines(file(scan + ".gt"));
    ASSERT_EQ(lines.size(), set == "box_met" ? 5U : 4U) << "one of the sets ends with a blank line";
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(std::regex_match(lines[i], row)) << lines[i];
    EXPECT_EQ(lines[3], "0.000000 0.000000 0.000000 1.000000");
    if (set == "box_met") {
      EXPECT_EQ(lines[4], "");
    }
  }
}

TEST_F(LidarLogs, PlanetaryPointsLieOnTheSand) {
  const Scene yard(describeSandYard(1));
  for (const std::string set : {"box_met", "p2at_met"}) {
    const std::string scan = "planetary/" + set + "/" + set + "_001/" + set + "_001";
    const pcrb::Transform pose = poseOf(numbersOf(readText(file(scan + ".gt"))), 0);
    std::vector<TimedPoint> points;
    for (const std::string& line : readLines(file(scan + ".xyz")))
      points.push_back({pose * pointOf(numbersOf(line), 0)});
    EXPECT_GT(points.size(), 40U * 30U / 2);
    EXPECT_GT(shareOnSurfaces(yard, pose, points, 0.07), 0.9) << set;
  }
}

TEST_F(LidarLogs, KaistCalibrationReadsAsTheRealOne) {
  EXPECT_EQ(
      readText(file("kaist/urban05/calibration/Vehicle2LeftVLP.txt")),
      "Left Velodyne (VLP-16) extrinsic calibration parameter from vehicle\n"
      "RPY(roll/pitch/yaw, degree), R(rotation matrix), T(translation matrix)\n"
      "RPY: 1.69162 44.9466 136.579\n"
      "R: -0.514066 -0.702201 -0.492595 0.486485 -0.711672 0.506809 -0.706447 0.0208933 0.707457\n"
      "T: -0.440699 0.397052 1.90953\n");
}

TEST_F(LidarLogs, KaistPosesAreAHundredHertzInUtmAndBeginAfterTheFirstScan) {
  const auto rows = readLines(file("kaist/urban05/global_pose.csv"));
  const auto stamps = readLines(file("kaist/urban05/sensor_data/VLP_left_stamp.csv"));
  ASSERT_GT(rows.size(), 20U);
  std::int64_t last = 0;
  for (const std::string& row : rows) {
    const std::int64_t stamp = std::stoll(row);
    if (last != 0) {
      EXPECT_NEAR(static_cast<double>(stamp - last), 1e7, 1e4);
    }
    last = stamp;
    const auto numbers = numbersOf(row);
    ASSERT_EQ(numbers.size(), 13U);
    const pcrb::Transform pose = poseOf(numbers, 1);
    EXPECT_LT((pose.linear() * pose.linear().transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-9);
    EXPECT_NEAR(pose.translation().x(), 3.534e5, 500.0);
    EXPECT_NEAR(pose.translation().y(), 4.0269e6, 500.0);
  }
  EXPECT_LT(std::stoll(stamps.at(0)), std::stoll(rows[0]));
  EXPECT_GT(std::stoll(stamps.at(1)), std::stoll(rows[0]));
}

TEST_F(LidarLogs, KaistScansAreRecordsOfFourFloatsOnTheStreetAndItsHouses) {
  const auto stamps = readLines(file("kaist/urban05/sensor_data/VLP_left_stamp.csv"));
  ASSERT_EQ(stamps.size(), 3U);
  for (const std::string& stamp : stamps) {
    const std::string bytes =
        readText(file("kaist/urban05/sensor_data/VLP_left/" + stamp + ".bin"));
    ASSERT_EQ(bytes.size() % 16, 0U);
    std::vector<float> values(bytes.size() / 4);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    int zeros = 0;
    int returns = 0;
    for (std::size_t i = 0; i < values.size(); i += 4) {
      const double range = Vector3d(values[i], values[i + 1], values[i + 2]).norm();
      EXPECT_TRUE(range == 0.0 || (range > 0.85 && range < 100.1)) << range;
      EXPECT_EQ(values[i + 3], std::round(values[i + 3])) << "intensity";
      EXPECT_LE(values[i + 3], 255.0F);
      (range == 0.0 ? zeros : returns) += 1;
    }
    EXPECT_GT(returns, 90 * 16 / 3);
    EXPECT_GT(zeros, 0) << "beams that come back as zeros";
  }
}

TEST(KaistLog, NamesStampsWhoseFilesAreMissing) {
  LogOptions options = tinyLogs();
  options.size.kaist_scans = 10;
  std::set<std::string> planned;
  const LogPlan plan = planKaistLogs(options);
  for (const LogJob& job : plan.jobs) planned.insert(job.files.begin(), job.files.end());
  TemporaryFolder folder;
  for (const LogJob& job : plan.jobs) {
    if (job.files.at(0).find("stamp") != std::string::npos) job.make(folder.path());
  }
  for (const std::string side : {"left", "right"}) {
    int missing = 0;
    for (const std::string& stamp :
         readLines(folder.file("kaist/urban05/sensor_data/VLP_" + side + "_stamp.csv"))) {
      missing += planned.count("kaist/urban05/sensor_data/VLP_" + side + "/" + stamp + ".bin") == 0;
    }
    EXPECT_EQ(missing, 1) << side;
  }
}

}  // namespace
}  // namespace pcrb_tools::simulation
