#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/transform.hpp"
#include "simulation/noise.hpp"
#include "simulation/props.hpp"
#include "simulation/sample_logs.hpp"
#include "simulation/scanner.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr char kFolder[] = "kaist/urban05/";
constexpr std::int64_t kClockNs = 1519102894000000000;  // Unix time of the start
constexpr double kRevolution = 0.1;                     // s
constexpr double kPoseInterval = 0.01;                  // s
constexpr std::int64_t kFirstPose = 15;                 // number; the first scan is taken before it
constexpr double kSpeed = 4.0;                          // m/s
constexpr double kNoReturnShare = 0.02;  // of lost beams that come as records of zeros

/// One of the two lidars on the roof.
struct Velodyne {
  std::string name;          ///< of its folder
  std::string title;         ///< of its calibration file
  Vector3d rpy_deg;          ///< of R = Rz(yaw) Ry(pitch) Rx(roll), sensor → vehicle
  Vector3d position;         ///< m, in the vehicle
  double phase;              ///< s, its revolutions' offset from the log's start
  std::vector<int> missing;  ///< scans that the stamps name and the disk has lost
};

std::vector<Velodyne> velodynes() {
  return {{"left", "Left", {1.69162, 44.9466, 136.579}, {-0.440699, 0.397052, 1.90953}, 0.0, {4}},
          {"right",
           "Right",
           {-1.20871, 44.6083, -136.242},
           {-0.448523, -0.402716, 1.91046},
           0.037,
           {6}}};
}

Eigen::Matrix3d rotationOf(const Vector3d& rpy_deg) {
  return (AngleAxisd(rpy_deg.z() * pcrb::kRadiansPerDegree, Vector3d::UnitZ()) *
          AngleAxisd(rpy_deg.y() * pcrb::kRadiansPerDegree, Vector3d::UnitY()) *
          AngleAxisd(rpy_deg.x() * pcrb::kRadiansPerDegree, Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Where the street lies in UTM.
pcrb::Transform utmFromStreet() { return atPlace({353412.7371, 4026881.3094, 19.6127}, 0.62); }

/// Pose of the car in the street: it drives on the right, weaves a little and sways on its springs.
pcrb::Transform streetFromVehicle(double time) {
  const double x = kSpeed * time;
  const double y = -1.3 + 0.25 * std::sin(0.12 * x);
  pcrb::Transform pose =
      atPlace({x, y, 0.01 * std::sin(6.0 * time)}, std::atan(0.03 * std::cos(0.12 * x)));
  pose.rotate(AngleAxisd(0.004 * std::sin(5.1 * time), Vector3d::UnitY()));
  pose.rotate(AngleAxisd(0.005 * std::sin(3.7 * time + 1.0), Vector3d::UnitX()));
  return pose;
}

/// Time of the end of a revolution, which is the scan's stamp: the sensor's clock is not perfect.
std::int64_t velodyneStamp(const Velodyne& velodyne, int scan, std::uint64_t seed) {
  pcrb::Random random =
      makeStream(seed, "urban05 stamp " + velodyne.name, static_cast<std::uint64_t>(scan));
  const double end = velodyne.phase + kRevolution * (scan + 1);
  return kClockNs + 1000 * std::llround(1e6 * end + random.uniform(-400.0, 400.0));
}

std::string scanFile(const Velodyne& velodyne, std::int64_t stamp) {
  return std::string(kFolder) + "sensor_data/VLP_" + velodyne.name + "/" + std::to_string(stamp) +
         ".bin";
}

/// Records of four little-endian floats.
std::string recordBytes(const std::vector<ScanPoint>& points, pcrb::Random& random) {
  std::string bytes;
  for (const ScanPoint& point : points) {
    if (point.position.isZero() && random.uniform() >= kNoReturnShare) continue;
    const float record[4] = {static_cast<float>(point.position.x()),
                             static_cast<float>(point.position.y()),
                             static_cast<float>(point.position.z()),
                             static_cast<float>(std::lround(100.0 * point.strength))};
    char raw[sizeof(record)];
    std::memcpy(raw, record, sizeof(record));
    bytes.append(raw, sizeof(record));
  }
  return bytes;
}

void makeKaistScan(const Velodyne& velodyne, const LazyScene& scene, const LogOptions& options,
                   int i, const std::string& output, const std::string& file) {
  pcrb::Transform T_vehicle_sensor = pcrb::Transform::Identity();
  T_vehicle_sensor.linear() = rotationOf(velodyne.rpy_deg);
  T_vehicle_sensor.translation() = velodyne.position;
  const auto pose = [&T_vehicle_sensor](double time) -> pcrb::Transform {
    return streetFromVehicle(time) * T_vehicle_sensor;
  };
  const double end =
      static_cast<double>(velodyneStamp(velodyne, i, options.seed) - kClockNs) * 1e-9;
  pcrb::Random random =
      makeStream(options.seed, "urban05 " + velodyne.name, static_cast<std::uint64_t>(i));
  const auto points =
      takeScan(scene.get(), makeVlp16(options.size.kaist_columns), pose, end - kRevolution, random);
  writeLogFile(output, file, recordBytes(points, random));
}

std::string stampsText(const Velodyne& velodyne, const LogOptions& options) {
  std::string text;
  for (int i = 0; i < options.size.kaist_scans; ++i) {
    text += std::to_string(velodyneStamp(velodyne, i, options.seed)) + "\n";
  }
  return text;
}

/// As the calibration software prints it: six significant digits.
std::string calibrationText(const Velodyne& velodyne) {
  const Eigen::Matrix3d R = rotationOf(velodyne.rpy_deg);
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << velodyne.title << " Velodyne (VLP-16) extrinsic calibration parameter from vehicle\n"
       << "RPY(roll/pitch/yaw, degree), R(rotation matrix), T(translation matrix)\n"
       << "RPY: " << velodyne.rpy_deg.x() << ' ' << velodyne.rpy_deg.y() << ' '
       << velodyne.rpy_deg.z() << "\nR:";
  for (int i = 0; i < 9; ++i) text << ' ' << R(i / 3, i % 3);
  text << "\nT: " << velodyne.position.x() << ' ' << velodyne.position.y() << ' '
       << velodyne.position.z() << '\n';
  return text.str();
}

/// Vehicle → UTM at 100 Hz.
std::string posesText(const LogOptions& options) {
  const PoseError pose_error(options.seed, options.ground_truth_error);
  const double length = kRevolution * (options.size.kaist_scans + 2);  // s
  std::string text;
  for (std::int64_t i = kFirstPose; i < std::llround(length / kPoseInterval); ++i) {
    const std::int64_t since_start = 10000000 * i + 1217 * (i % 7);
    const double time = static_cast<double>(since_start) * 1e-9;
    const pcrb::Transform pose =
        displaced(utmFromStreet() * streetFromVehicle(time), pose_error.at(time));
    text += std::to_string(kClockNs + since_start);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        text += ',';
        pcrb::appendShortest(text, pose.matrix()(row, column));
      }
    }
    text += '\n';
  }
  return text;
}

LogJob textJob(const std::string& file, const std::function<std::string()>& text) {
  return {{file}, [=](const std::string& output) { writeLogFile(output, file, text()); }};
}

}  // namespace

LogPlan planKaistLogs(const LogOptions& options) {
  LogPlan plan;
  const LazyScene scene = lazyScene(describeStreet, options.seed);
  const PoseError pose_error(options.seed, options.ground_truth_error);
  const std::string folder = kFolder;
  for (const Velodyne& velodyne : velodynes()) {
    for (int i = 0; i < options.size.kaist_scans; ++i) {
      if (std::count(velodyne.missing.begin(), velodyne.missing.end(), i) > 0) continue;
      const std::int64_t stamp = velodyneStamp(velodyne, i, options.seed);
      const std::string file = scanFile(velodyne, stamp);
      plan.jobs.push_back({{file}, [=](const std::string& output) {
                             makeKaistScan(velodyne, scene, options, i, output, file);
                           }});
      if (velodyne.name != "left") continue;
      plan.errors.push_back({"kaist", "urban05", "urban05_" + std::to_string(stamp) + ".pcd",
                             pose_error.at(static_cast<double>(stamp - kClockNs) * 1e-9)});
    }
    plan.jobs.push_back(textJob(folder + "sensor_data/VLP_" + velodyne.name + "_stamp.csv",
                                [=] { return stampsText(velodyne, options); }));
    plan.jobs.push_back(textJob(folder + "calibration/Vehicle2" + velodyne.title + "VLP.txt",
                                [=] { return calibrationText(velodyne); }));
  }
  plan.jobs.push_back(textJob(folder + "global_pose.csv", [=] { return posesText(options); }));
  return plan;
}

}  // namespace pcrb_tools::simulation
