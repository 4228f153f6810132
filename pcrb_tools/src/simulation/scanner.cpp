#include "simulation/scanner.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/noise.hpp"

namespace pcrb_tools::simulation {
namespace {

/// Echoes nearer to each other than this merge into one: the length of a light pulse, m.
constexpr double kPulseLength = 1.0;

/// Range of a beam whose footprint lies on two surfaces: between the two, where they are near
/// enough to merge, else that of the first.
double mixedRange(const Scene::Snapshot& scene, const Ray& ray, const LidarModel& lidar,
                  double range, pcrb::Random& random) {
  const Eigen::Vector3d aside = ray.direction.cross(random.direction()) * lidar.beam_radius;
  const Ray rim{ray.origin, (ray.direction + aside).normalized()};
  const std::optional<Hit> other = scene.cast(rim, lidar.max_range);
  const double share = 0.5 * random.uniform();
  if (!other || std::abs(other->distance - range) > kPulseLength) return range;
  return range + share * (other->distance - range);
}

using Eigen::AngleAxisd;
using Eigen::Vector3d;

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

std::optional<Echo> measure(const Scene::Snapshot& scene, const Ray& ray, const LidarModel& lidar,
                            pcrb::Random& random) {
  const bool lost = random.uniform() < lidar.lost_share;
  const bool mixed = random.uniform() < lidar.mixed_share;
  const double noise = lidar.range_noise * drawNormal(random);
  const std::optional<Hit> hit = scene.cast(ray, lidar.max_range);
  if (!hit || lost) return std::nullopt;

  const double strength =
      hit->surface.reflectivity * std::min(1.0, std::abs(hit->normal.dot(ray.direction)));
  const double attenuation = hit->distance / lidar.max_range;
  if (strength < lidar.weakest_echo * attenuation * attenuation) return std::nullopt;

  double range = hit->distance;
  if (mixed) range = mixedRange(scene, ray, lidar, range, random);
  range = std::round((range + noise) / lidar.resolution) * lidar.resolution;
  if (range < lidar.min_range || range > lidar.max_range) return std::nullopt;
  return Echo{range, strength};
}

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
