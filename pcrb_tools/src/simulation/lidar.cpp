#include "simulation/lidar.hpp"

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

}  // namespace pcrb_tools::simulation
