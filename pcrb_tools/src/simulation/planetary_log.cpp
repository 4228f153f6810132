#include <cmath>
#include <string>
#include <vector>

#include "pcrb_core/io/number.hpp"
#include "simulation/noise.hpp"
#include "simulation/props.hpp"
#include "simulation/sample_logs.hpp"
#include "simulation/scanner.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;

struct PlanetarySequence {
  std::string name;
  Scanner (*scanner)(int lines, int beams);
  std::vector<Vector3d> path;  ///< m; z is the sensor's height above the ground
  double spacing;              ///< m, between scans at most
  std::string last_line;       ///< of the .gt files
};

constexpr double kPlanetaryInterval = 90.0;  // s, from stop to stop
constexpr int kDecimals = 6;

std::vector<PlanetarySequence> planetaryPlans() {
  return {{"box_met",
           makePanningSick,
           {{-4.0, 0.0, 1.6},
            {4.0, -1.0, 1.6},
            {9.0, -4.0, 1.6},
            {8.0, -12.0, 1.6},
            {-10.0, -12.0, 1.6}},
           1.4,
           "\n"},
          {"p2at_met",
           makeTiltingSick,
           {{-5.0, -1.5, 0.9},
            {2.0, 0.5, 0.9},
            {8.0, -3.0, 0.9},
            {6.0, -11.0, 0.9},
            {-9.0, -11.0, 0.9}},
           0.7,
           ""}};
}

/// Pose of a sensor on a platform that stands on the slope of the ground.
pcrb::Transform sensorPose(const PlanetarySequence& sequence, const Scene& scene, int i,
                           const LogOptions& options) {
  pcrb::Random random =
      makeStream(options.seed, sequence.name + " pose", static_cast<std::uint64_t>(i));
  const double arc = stopAt(i, options.size.planetary_scans, sequence.path, sequence.spacing);
  const PathPoint stop = followPath(sequence.path, arc);
  const double x = stop.position.x();
  const double y = stop.position.y();
  constexpr double kTrack = 0.4;  // m, half the distance of the wheels
  const Vector3d up(scene.groundHeight(x - kTrack, y) - scene.groundHeight(x + kTrack, y),
                    scene.groundHeight(x, y - kTrack) - scene.groundHeight(x, y + kTrack),
                    2.0 * kTrack);
  pcrb::Transform pose = pcrb::Transform::Identity();
  pose.translation() = Vector3d(x, y, scene.groundHeight(x, y));
  pose.rotate(Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up));
  pose.rotate(Eigen::AngleAxisd(stop.heading + 0.25 * drawNormal(random), Vector3d::UnitZ()));
  pose.translate(Vector3d(0.0, 0.0, stop.position.z()));
  return pose;
}

std::string pointsText(const std::vector<ScanPoint>& points) {
  std::string text;
  for (const ScanPoint& point : points) {
    if (point.position.isZero()) continue;
    pcrb::appendFixed(text, point.position.x(), kDecimals);
    text += ' ';
    pcrb::appendFixed(text, point.position.y(), kDecimals);
    text += ' ';
    pcrb::appendFixed(text, point.position.z(), kDecimals);
    text += '\n';
  }
  return text;
}

std::string poseText(const pcrb::Transform& pose) {
  std::string text;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      pcrb::appendFixed(text, pose.matrix()(row, column), kDecimals);
      text += column < 3 ? ' ' : '\n';
    }
  }
  return text;
}

void makePlanetaryScan(const PlanetarySequence& sequence, const LazyScene& scene,
                       const LogOptions& options, int i, const std::string& output,
                       const std::vector<std::string>& files) {
  const LogSize& size = options.size;
  const pcrb::Transform truth = sensorPose(sequence, scene.get(), i, options);
  const double start = kPlanetaryInterval * i;
  pcrb::Random random = makeStream(options.seed, sequence.name, static_cast<std::uint64_t>(i));
  const auto points =
      takeScan(scene.get(), sequence.scanner(size.planetary_lines, size.planetary_beams),
               standAt(truth), start, random);
  const Vector3d error = PoseError(options.seed, options.ground_truth_error).at(start);
  writeLogFile(output, files.at(0), pointsText(points));
  writeLogFile(output, files.at(1), poseText(displaced(truth, error)) + sequence.last_line);
}

/// `box_met_007` of the scan with number 7.
std::string scanName(const std::string& sequence, int i) {
  const std::string number = std::to_string(i);
  return sequence + "_" + std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number;
}

/// Where a scan's files are, without their suffix.
std::string scanPath(const std::string& sequence, const std::string& name) {
  return "planetary/" + sequence + "/" + name + "/" + name;
}

}  // namespace

LogPlan planPlanetaryLogs(const LogOptions& options) {
  LogPlan plan;
  const LazyScene scene = lazyScene(describeSandYard, options.seed);
  const PoseError pose_error(options.seed, options.ground_truth_error);
  for (const PlanetarySequence& sequence : planetaryPlans()) {
    for (int i = 0; i < options.size.planetary_scans; ++i) {
      const std::string name = scanName(sequence.name, i);
      const std::string path = scanPath(sequence.name, name);
      const std::vector<std::string> files{path + ".xyz", path + ".gt"};
      plan.jobs.push_back({files, [=](const std::string& output) {
                             makePlanetaryScan(sequence, scene, options, i, output, files);
                           }});
      plan.errors.push_back(
          {"planetary", sequence.name, name + ".pcd", pose_error.at(kPlanetaryInterval * i)});
    }
  }
  return plan;
}

}  // namespace pcrb_tools::simulation
