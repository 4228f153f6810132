#include "simulation/scanner.hpp"

#include <cmath>

namespace pcrb_tools::simulation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kPi = 3.141592653589793;

double radians(double degrees) { return degrees * kPi / 180.0; }

/// Value `i` of `count` evenly spaced ones from `first` to `last`.
double evenly(double first, double last, int i, int count) {
  return count == 1 ? first : first + (last - first) * i / (count - 1);
}

/// Direction of a beam in the sensor's frame.
Vector3d beamDirection(Scanner::Head head, double head_angle, double beam_angle) {
  const double c = std::cos(beam_angle);
  const double s = std::sin(beam_angle);
  if (head == Scanner::Head::kTilting) {
    return AngleAxisd(head_angle, Vector3d::UnitY()) * Vector3d(c, s, 0.0);
  }
  return AngleAxisd(head_angle, Vector3d::UnitZ()) * Vector3d(c, 0.0, s);
}

}  // namespace

double lineTime(const Scanner& scanner, int line) {
  return scanner.duration * (line + 0.5) / scanner.lines;
}

std::vector<ScanPoint> takeScan(const Scene& scene, const Scanner& scanner,
                                const Motion& T_world_sensor, double start_time,
                                pcrb::Random& random) {
  std::vector<ScanPoint> points;
  points.reserve(static_cast<std::size_t>(scanner.lines) * static_cast<std::size_t>(scanner.beams));
  for (int line = 0; line < scanner.lines; ++line) {
    const double time = start_time + lineTime(scanner, line);
    const Scene::Snapshot snapshot = scene.at(time);
    const pcrb::Transform pose = T_world_sensor(time);
    const double head = evenly(scanner.first_head, scanner.last_head, line, scanner.lines);
    for (int beam = 0; beam < scanner.beams; ++beam) {
      const double angle = evenly(scanner.first_beam, scanner.last_beam, beam, scanner.beams);
      const Vector3d direction = beamDirection(scanner.head, head, angle);
      const Ray ray{pose.translation(), pose.linear() * direction};
      const auto echo = measure(snapshot, ray, scanner.lidar, random);
      points.push_back({echo ? Vector3d(echo->range * direction) : Vector3d::Zero(),
                        echo ? echo->strength : 0.0, time, line, beam});
    }
  }
  return points;
}

Scanner makeTiltingHokuyo(int lines, int beams) {
  const LidarModel lidar{0.1, 30.0, 0.010, 0.001, 0.0015, 0.2, 0.01, 0.02};
  return {Scanner::Head::kTilting, lidar,           lines,          beams, radians(-80.0),
          radians(80.0),           radians(-135.0), radians(135.0), 8.6};
}

Scanner makePanningSick(int lines, int beams) {
  const LidarModel lidar{0.5, 32.0, 0.012, 0.001, 0.004, 0.15, 0.01, 0.05};
  return {Scanner::Head::kPanning,         lidar,          lines,         beams, radians(180.0),
          radians(-180.0 + 360.0 / lines), radians(-70.0), radians(10.0), 60.0};
}

Scanner makeTiltingSick(int lines, int beams) {
  const LidarModel lidar{0.5, 20.0, 0.015, 0.001, 0.004, 0.15, 0.01, 0.05};
  return {Scanner::Head::kTilting, lidar,          lines,         beams, radians(-8.0),
          radians(60.0),           radians(-90.0), radians(90.0), 30.0};
}

Scanner makeVlp16(int columns) {
  const LidarModel lidar{0.9, 100.0, 0.012, 0.002, 0.0015, 0.1, 0.01, 0.01};
  return {Scanner::Head::kPanning,           lidar,          columns,       16, radians(180.0),
          radians(-180.0 + 360.0 / columns), radians(-15.0), radians(15.0), 0.1};
}

}  // namespace pcrb_tools::simulation
