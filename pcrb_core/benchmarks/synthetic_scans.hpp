#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace pcrb_benchmark {

/// A sequence of deterministic scans in one frame, m: what overlap is measured on.
///
/// `room`: 12 × 8 × 2.8 m with 40 boxes, scanned every 0.5 m along a path, 1 cm noise. `terrain`:
/// hills of 80 × 80 m with 150 boxes, scanned every 2 m, 2 cm noise. Each scan sends its rays in
/// equal steps of azimuth and elevation, as a spinning or tilting lidar does, so that density falls
/// with the square of the distance.
class SyntheticScans {
 public:
  explicit SyntheticScans(const std::string& scene) : room_(scene == "room") {
    std::mt19937_64 bits(room_ ? 11 : 12);
    const auto uniform = [&bits](double low, double high) {
      return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1.0p-53;
    };
    const double x = room_ ? 6.0 : 40.0;
    const double y = room_ ? 4.0 : 40.0;
    for (int i = 0; i < (room_ ? 40 : 150); ++i) {
      const Eigen::Vector3d low(uniform(-x, x), uniform(-y, y), room_ ? uniform(0.0, 1.5) : -3.0);
      const double size = room_ ? 1.0 : 3.0;
      boxes_.emplace_back(low,
                          low + Eigen::Vector3d(uniform(0.1, size), uniform(0.1, size),
                                                room_ ? uniform(0.1, 1.2) : uniform(3.0, 9.0)));
    }
  }

  double distance() const { return room_ ? 0.1 : 0.2; }

  std::vector<Eigen::Vector3d> scan(int index, std::size_t points) const {
    std::mt19937_64 bits(static_cast<std::uint64_t>(index) + 1000);
    const double angle = 2.0 * M_PI * index / 40.0;
    const double radius = room_ ? 3.0 : 12.0;
    const Eigen::Vector3d sensor(radius * std::cos(angle),
                                 (room_ ? 0.8 : 1.0) * radius * std::sin(angle), room_ ? 1.1 : 6.0);
    std::vector<Eigen::Vector3d> cloud;
    cloud.reserve(points);
    const auto columns = static_cast<std::size_t>(std::sqrt(3.0 * static_cast<double>(points)));
    for (std::size_t ray = 0; cloud.size() < points; ++ray) {
      const double jitter = static_cast<double>(bits() >> 11) * 0x1.0p-53;
      const double azimuth =
          2.0 * M_PI * (static_cast<double>(ray % columns) + jitter) / static_cast<double>(columns);
      const std::size_t turns = ray / columns;
      const double turn = static_cast<double>(turns) * 3.0 * 0.618 / static_cast<double>(columns);
      const double elevation =
          (turn - std::floor(turn) - 0.5) * (room_ ? 2.6 : 1.2) - (room_ ? 0.0 : 0.4);
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double range = hit(sensor, direction);
      if (range > (room_ ? 30.0 : 60.0)) continue;
      double noise = -6.0;
      for (int i = 0; i < 12; ++i) noise += static_cast<double>(bits() >> 11) * 0x1.0p-53;
      cloud.push_back(sensor + direction * (range + noise * (room_ ? 0.01 : 0.02)));
    }
    return cloud;
  }

 private:
  static double height(double x, double y) {
    return 1.5 * std::sin(0.11 * x) * std::cos(0.13 * y) + 0.3 * std::sin(0.7 * x + 0.4 * y);
  }

  double hit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& box : boxes_) nearest = std::min(nearest, hitBox(box, from, direction));
    return std::min(nearest,
                    room_ ? hitWalls(from, direction) : hitGround(from, direction, nearest));
  }

  static double hitBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& direction) {
    const Eigen::Array3d a = (box.min() - from).array() / direction.array();
    const Eigen::Array3d b = (box.max() - from).array() / direction.array();
    const double enter = a.min(b).maxCoeff();
    const double leave = a.max(b).minCoeff();
    return enter > 0.05 && enter <= leave ? enter : std::numeric_limits<double>::infinity();
  }

  static double hitWalls(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
    const Eigen::AlignedBox3d walls(Eigen::Vector3d(-6, -4, 0), Eigen::Vector3d(6, 4, 2.8));
    const Eigen::Array3d a = (walls.min() - from).array() / direction.array();
    const Eigen::Array3d b = (walls.max() - from).array() / direction.array();
    return a.max(b).minCoeff();
  }

  static double hitGround(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                          double limit) {
    double range = 0.5;
    while (range < std::min(limit, 61.0)) {
      const Eigen::Vector3d at = from + range * direction;
      const double above = at.z() - height(at.x(), at.y());
      if (above < 0.005) return range;
      range += std::max(0.005, 0.4 * above);
    }
    return std::numeric_limits<double>::infinity();
  }

  bool room_;
  std::vector<Eigen::AlignedBox3d> boxes_;
};

}  // namespace pcrb_benchmark
