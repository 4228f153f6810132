#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "pcrb_core/random.hpp"
#include "simulation/scene.hpp"

namespace pcrb_tools::simulation {

/// Shapes that make up one thing, in its own frame: z up from the floor, x to its front.
using Prop = std::vector<Shape>;

// Solids. All lengths in m, all angles in rad; `yaw` and `tilt` turn about z, then y.

Shape makeBox(const Eigen::Vector3d& center, const Eigen::Vector3d& size, const Surface& surface,
              double yaw = 0.0, double tilt = 0.0);
/// Upright, standing on `foot`.
Shape makeColumn(const Eigen::Vector3d& foot, double radius, double height, const Surface& surface);
/// Cylinder with its axis from one point to another.
Shape makeRod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
              const Surface& surface);
Shape makeEllipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii,
                    const Surface& surface, double yaw = 0.0);

/// Adds a prop to a scene, at a place and turned about z.
void place(SceneDescription& scene, const Prop& prop, const Eigen::Vector3d& position,
           double yaw = 0.0);

/// The position and yaw as a pose.
pcrb::Transform atPlace(const Eigen::Vector3d& position, double yaw);

// Indoor props.

Prop makeTable(double length, double width, double height, const Surface& top);
Prop makeChair(const Surface& seat);
Prop makeSofa(const Surface& fabric);
Prop makeBed();
/// Shelf with boards and books of random sizes and colours.
Prop makeBookshelf(double width, double height, pcrb::Random& random);
Prop makeCupboard(double width, double depth, double height, const Surface& surface);
Prop makeMonitor();
Prop makeLamp();
Prop makePottedPlant(pcrb::Random& random);
Prop makeTeddyBear();
/// What lies about on a desk or floor: up to `count` cups, bottles, books, boxes and balls at
/// random places, apart from each other.
Prop makeClutter(double length, double width, int count, pcrb::Random& random);

// People and outdoor props.

Prop makePerson(const Surface& clothes);
/// Stem, some branches, and a crown made of clumps of leaves.
Prop makeTree(double height, double stem_radius, int clumps, pcrb::Random& random);
Prop makeBush(double radius, int clumps, pcrb::Random& random);
/// Boulder of a few overlapping blocks and lumps.
Prop makeRock(double size, pcrb::Random& random);
Prop makeCar(const Surface& paint);
/// House with windows, a door and a saddle roof; x to the street.
Prop makeHouse(double depth, double width, double height, const Surface& wall);

/// Stays where it is.
Motion standAt(const pcrb::Transform& pose);

/// Walks from a to b and back for ever, facing the way it goes. m, m/s, s.
Motion walkBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double speed,
                   double start_time);

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
