#include "simulation/depth_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/height_field.hpp"
#include "simulation/noise.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kMinDepth = 0.5;         // m
constexpr double kFarthestDepth = 5.0;    // m
constexpr double kSight = 50.0;           // m, of the colour camera
constexpr double kBaseline = 0.075;       // m, projector to infrared camera
constexpr double kInfraredFocal = 580.0;  // pixels
constexpr double kDisparityNoise = 0.05;  // pixels, standard deviation
constexpr double kDisparityStep = 0.125;  // pixels
constexpr double kWeakestReturn = 0.05;   // reflectivity · cos(incidence)
constexpr double kLostShare = 0.004;      // pixels without depth for no visible reason

/// Depth as the sensor measures it from a disparity, m.
double measuredDepth(double depth, pcrb::Random& random) {
  const double noisy = kBaseline * kInfraredFocal / depth + kDisparityNoise * drawNormal(random);
  const double disparity = std::round(noisy / kDisparityStep) * kDisparityStep;
  return 1e-3 * std::round(1e3 * kBaseline * kInfraredFocal / disparity);
}

/// Whether the projector, beside the camera, lights the point that the camera sees.
bool isLit(const Scene::Snapshot& scene, const Vector3d& point, const Vector3d& normal,
           const Vector3d& projector) {
  const Vector3d lifted = point + 2e-3 * normal;
  const Vector3d to_projector = projector - lifted;
  const double distance = to_projector.norm();
  return !scene.cast({lifted, to_projector / distance}, distance);
}

/// Brightness of a surface under a lamp at the ceiling, with a fine grain.
std::uint8_t shade(float channel, const Vector3d& point, const Vector3d& normal) {
  const double light = 0.45 + 0.55 * std::abs(normal.dot(Vector3d(0.25, 0.35, 0.9)));
  const double grain =
      1.0 + 0.10 * valueNoise(23.0 * (point.x() + point.z()), 23.0 * (point.y() - point.z()), 1);
  return static_cast<std::uint8_t>(std::clamp(255.0 * channel * light * grain, 0.0, 255.0));
}

/// Depth of a pixel, m; NaN where the camera sees none.
float depthOf(const Scene::Snapshot& scene, const Ray& ray, const Hit& hit, double depth,
              const Vector3d& projector, pcrb::Random& random) {
  const double strength = hit.surface.reflectivity * std::abs(hit.normal.dot(ray.direction));
  const bool lost = random.uniform() < kLostShare;
  const double measured = measuredDepth(depth, random);
  if (lost || depth < kMinDepth || depth > kFarthestDepth || strength < kWeakestReturn ||
      !isLit(scene, ray.origin + hit.distance * ray.direction, hit.normal, projector)) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  return static_cast<float>(measured);
}

}  // namespace

DepthCamera makeKinect(int divisor) {
  const double scale = 1.0 / divisor;
  return {640 / divisor, 480 / divisor, 525.0 * scale, (319.5 + 0.5) * scale - 0.5,
          (239.5 + 0.5) * scale - 0.5};
}

RgbdFrame takeFrame(const Scene& scene, const DepthCamera& camera,
                    const pcrb::Transform& T_world_camera, double time, pcrb::Random& random) {
  const Scene::Snapshot snapshot = scene.at(time);
  const Vector3d projector = T_world_camera * Vector3d(kBaseline, 0.0, 0.0);
  RgbdFrame frame;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vector3d beam((u - camera.center_x) / camera.focal,
                          (v - camera.center_y) / camera.focal, 1.0);
      const double stretch = beam.norm();
      const Ray ray{T_world_camera.translation(), T_world_camera.linear() * beam / stretch};
      const std::optional<Hit> hit = snapshot.cast(ray, kSight);
      if (!hit) {
        frame.depth.push_back(std::numeric_limits<float>::quiet_NaN());
        frame.color.insert(frame.color.end(), 3, 0);
        continue;
      }
      frame.depth.push_back(
          depthOf(snapshot, ray, *hit, hit->distance / stretch, projector, random));
      const Vector3d point = ray.origin + hit->distance * ray.direction;
      for (int channel = 0; channel < 3; ++channel) {
        frame.color.push_back(shade(hit->surface.color[channel], point, hit->normal));
      }
    }
  }
  return frame;
}

}  // namespace pcrb_tools::simulation
