#include "pcrb_tools/demo_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/overlap.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"
#include "pcrb_core/problem/perturbation_sampling.hpp"
#include "pcrb_core/problem/problem_file.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb_tools {
namespace {

constexpr double kPi = 3.14159265358979323846;
const Eigen::Vector3d kHall(20.0, 12.0, 5.0);  // m, one corner at the origin
constexpr std::size_t kBoxes = 16;
constexpr double kSensorHeight = 1.5;  // m
constexpr int kRings = 48;
constexpr int kBeams = 240;      // per ring
constexpr double kNoise = 0.02;  // m, uniform range noise of at most so much

using Box = Eigen::AlignedBox3d;

std::vector<Box> furnish(pcrb::Random& random) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < kBoxes; ++i) {
    const Eigen::Vector3d size(random.uniform(0.4, 2.5), random.uniform(0.4, 2.5),
                               random.uniform(0.5, 3.5));
    // Along the long walls: the middle is left to the scanner.
    const double y = i % 2 == 0 ? random.uniform(0.0, 2.0) : random.uniform(7.5, 9.5);
    const Eigen::Vector3d corner(random.uniform(0.0, kHall.x() - size.x()), y, 0.0);
    boxes.emplace_back(corner, corner + size);
  }
  return boxes;
}

/// Distances along a ray at which it enters and leaves a box (slab method); NaN-free because no
/// component of a direction is zero.
std::pair<double, double> crossing(const Box& box, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) {
  const Eigen::Array3d to_min = (box.min() - origin).array() / direction.array();
  const Eigen::Array3d to_max = (box.max() - origin).array() / direction.array();
  return {to_min.min(to_max).maxCoeff(), to_min.max(to_max).minCoeff()};
}

double measureRange(const std::vector<Box>& boxes, const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& direction) {
  double range = crossing(Box(Eigen::Vector3d::Zero(), kHall), origin, direction).second;
  for (const Box& box : boxes) {
    const auto [enter, leave] = crossing(box, origin, direction);
    if (enter > 0.0 && enter < leave) range = std::min(range, enter);
  }
  return range;
}

pcrb::Transform sensorPose(std::size_t scan, std::size_t scans) {
  const double progress = (static_cast<double>(scan) + 0.5) / static_cast<double>(scans);
  const Eigen::Vector3d position(2.0 + (kHall.x() - 4.0) * progress,
                                 5.0 + 0.8 * std::sin(2.0 * kPi * progress), kSensorHeight);
  return pcrb::makeTransform(
      position, Eigen::Quaterniond(Eigen::AngleAxisd(progress, Eigen::Vector3d::UnitZ())));
}

pcrb::DatasetCloud scanHall(const std::vector<Box>& boxes, const pcrb::Transform& T_hall_sensor,
                            pcrb::Random& random) {
  pcrb::DatasetCloud cloud;
  cloud.viewpoint = T_hall_sensor;
  const Eigen::Vector3d origin = T_hall_sensor.translation();
  for (int ring = 0; ring < kRings; ++ring) {
    const double elevation = (-50.0 + 100.0 * (ring + 0.5) / kRings) * kPi / 180.0;
    for (int beam = 0; beam < kBeams; ++beam) {
      // A beam starts at a random phase, as nothing keeps a real scanner's beams in place.
      const double azimuth = 2.0 * kPi * (beam + random.uniform()) / kBeams;
      const Eigen::Vector3d direction =
          T_hall_sensor.linear() * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                   std::cos(elevation) * std::sin(azimuth),
                                                   std::sin(elevation));
      const double range = measureRange(boxes, origin, direction) + random.uniform(-kNoise, kNoise);
      cloud.points.push_back(origin + range * direction);
    }
  }
  return cloud;
}

std::string scanName(std::size_t scan) { return "hall_" + std::to_string(scan) + ".pcd"; }

pcrb::OverlapMatrix overlapsOf(const std::string& folder, std::size_t scans, double distance) {
  pcrb::OverlapJob job;
  job.distance = distance;
  std::vector<std::string> names;
  for (std::size_t scan = 0; scan < scans; ++scan) {
    names.push_back(scanName(scan));
    job.files.push_back(folder + "/" + scanName(scan));
    job.targets.push_back(scan);
  }
  pcrb::OverlapMatrix matrix(names);
  pcrb::OverlapEvents events;
  events.column_done = [&](std::size_t target, const std::vector<double>& column) {
    for (std::size_t source = 0; source < scans; ++source) {
      matrix.at(source, target) = column[source];
    }
  };
  pcrb::computeOverlaps(job, events);
  return matrix;
}

}  // namespace

void makeDemoSequence(const std::string& root, const DemoSequence& demo) {
  const std::string folder = root + "/demo/hall";
  std::filesystem::create_directories(folder);
  const pcrb::Dataset dataset = pcrb::loadDataset(root, "demo");

  pcrb::Random random(pcrb::streamSeed(demo.seed, "demo hall"));
  const std::vector<Box> boxes = furnish(random);
  std::vector<Eigen::Vector3d> centroids;
  for (std::size_t scan = 0; scan < demo.scans; ++scan) {
    const pcrb::DatasetCloud cloud = scanHall(boxes, sensorPose(scan, demo.scans), random);
    centroids.push_back(pcrb::centroid(cloud));
    pcrb::writePcd(folder + "/" + scanName(scan), cloud);
  }

  const pcrb::OverlapMatrix matrix = overlapsOf(folder, demo.scans, dataset.overlap_distance);
  const auto centroidOf = [&](const std::string& source) {
    const auto name = std::find(matrix.names.begin(), matrix.names.end(), source);
    return centroids[static_cast<std::size_t>(name - matrix.names.begin())];
  };
  for (const pcrb::Kind kind : {pcrb::Kind::kLocal, pcrb::Kind::kGlobal}) {
    const auto pairs = pcrb::samplePairs(pcrb::eligiblePairs(matrix, kind), demo.pairs, random);
    const auto problems =
        pcrb::sampleProblems({"hall", kind, pairs, dataset.bounds(kind)}, demo.seed, centroidOf);
    pcrb::writeProblemFile(folder + "_" + pcrb::toString(kind) + ".txt", problems);
  }
}

}  // namespace pcrb_tools
