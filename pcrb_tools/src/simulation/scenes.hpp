#pragma once

#include <cstdint>

#include "simulation/scene.hpp"

namespace pcrb_tools::simulation {

// The places of the sample logs, each in its own frame: metres, z up, the floor or ground near
// z = 0. What is random in them (trees, rocks, books) depends on the seed only.

/// Flat of 9.5 m × 7 m: living room with kitchen (x < 5), hall (5 to 6.3), bathroom and bedroom;
/// two people walk about.
SceneDescription describeApartment(std::uint64_t seed);

/// Clearing and path (y ≈ woodPath(x)) among trees and bushes on uneven ground; a walker.
SceneDescription describeWood(std::uint64_t seed);
double woodPath(double x);

/// Rolling sand with ripples, three craters and rocks of all sizes, 90 m × 90 m.
SceneDescription describeSandYard(std::uint64_t seed);

/// Office of 9 m × 6 m about the origin, with a block of two desks at its middle.
SceneDescription describeOffice(std::uint64_t seed);

/// Street along x from −40 m to 140 m, 9 m wide, with parked cars and two that drive.
SceneDescription describeStreet(std::uint64_t seed);

}  // namespace pcrb_tools::simulation
