#pragma once

#include <optional>

#include "pcrb_core/random.hpp"
#include "simulation/scene.hpp"

namespace pcrb_tools::simulation {

/// How a time-of-flight lidar measures along one beam.
struct LidarModel {
  double min_range;     ///< m
  double max_range;     ///< m
  double range_noise;   ///< m, standard deviation
  double resolution;    ///< m, ranges are multiples of it
  double beam_radius;   ///< rad, half the beam's divergence
  double mixed_share;   ///< share of beams that see the rim of their footprint too: mixed pixels
  double lost_share;    ///< share of echoes lost for no visible reason
  double weakest_echo;  ///< of reflectivity · cos(incidence) · (max_range / range)²: less is lost
};

/// What comes back from one beam.
struct Echo {
  double range;     ///< m, as the sensor reports it
  double strength;  ///< reflectivity · cos(incidence), [0, 1]
};

/// Measures along a ray that starts at the sensor; nothing where no echo comes back.
std::optional<Echo> measure(const Scene::Snapshot& scene, const Ray& ray, const LidarModel& lidar,
                            pcrb::Random& random);

}  // namespace pcrb_tools::simulation
