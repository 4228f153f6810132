#include "simulation/log_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>

#include "pcrb_core/io/atomic_file.hpp"
#include "simulation/noise.hpp"

namespace pcrb_tools::simulation {

using Eigen::Vector3d;

LazyScene lazyScene(SceneDescription (*describe)(std::uint64_t), std::uint64_t seed) {
  return std::async(std::launch::deferred, [describe, seed] { return Scene(describe(seed)); })
      .share();
}

PoseError::PoseError(std::uint64_t seed, double length) : length_(length) {
  pcrb::Random random = makeStream(seed, "ground truth error");
  azimuth_ = random.uniform(0.0, 6.28);
  elevation_ = random.uniform(0.0, 6.28);
}

Vector3d PoseError::at(double time) const {
  const double azimuth = azimuth_ + 1.3 * time;
  const double elevation = std::sin(elevation_ + 0.93 * time);
  return length_ * Vector3d(std::cos(elevation) * std::cos(azimuth),
                            std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
}

pcrb::Transform displaced(const pcrb::Transform& T_world_sensor, const Vector3d& error) {
  return Eigen::Translation3d(error) * T_world_sensor;
}

PathPoint followPath(const std::vector<Vector3d>& corners, double arc_length) {
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vector3d leg = corners[i + 1] - corners[i];
    if (arc_length <= leg.norm() || i + 2 == corners.size()) {
      const double share = std::clamp(arc_length / leg.norm(), 0.0, 1.0);
      return {corners[i] + share * leg, std::atan2(leg.y(), leg.x())};
    }
    arc_length -= leg.norm();
  }
  return {corners.front(), 0.0};
}

double pathLength(const std::vector<Vector3d>& corners) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    length += (corners[i + 1] - corners[i]).norm();
  return length;
}

double stopAt(int i, int count, const std::vector<Vector3d>& corners, double spacing) {
  return i * std::min(spacing, pathLength(corners) / std::max(1, count - 1));
}

void writeLogFile(const std::string& output, const std::string& file, const std::string& bytes) {
  const std::filesystem::path path = std::filesystem::path(output) / file;
  std::filesystem::create_directories(path.parent_path());
  pcrb::writeFileAtomically(path.string(), bytes);
}

}  // namespace pcrb_tools::simulation
