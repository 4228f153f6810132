#include <algorithm>
#include <cmath>
#include <vector>

#include "simulation/noise.hpp"
#include "simulation/props.hpp"
#include "simulation/surfaces.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStreetBegin = -40.0;  // m
constexpr double kStreetEnd = 140.0;    // m

/// An old crater, its wall slumped and its outline uneven: height over the surroundings, m.
double craterHeight(const Vector2d& offset, double radius, std::uint64_t lattice) {
  const double outline = 1.0 + 0.25 * fractalNoise(offset.x(), offset.y(), lattice, 4.0, 2, 0.5);
  const double r = offset.norm() / (radius * outline);
  const double bowl = r < 1.0 ? -0.14 * radius * (1.0 - r * r) * (1.0 - r * r) : 0.0;
  return bowl + 0.05 * radius * std::exp(-6.0 * (r - 1.0) * (r - 1.0));
}

Vector3d onGround(const SceneDescription& scene, double x, double y) {
  return {x, y, scene.ground->height(x, y)};
}

/// Places trees at random, apart from each other and from the path.
void plantTrees(SceneDescription& scene, int count, double reach, pcrb::Random& random) {
  std::vector<Vector2d> stems;
  while (static_cast<int>(stems.size()) < count) {
    const Vector2d stem = drawBetween({-reach, -reach, 0.0}, {reach, reach, 0.0}, random).head<2>();
    if (std::abs(stem.y() - woodPath(stem.x())) < 1.6) continue;
    const bool crowded = std::any_of(stems.begin(), stems.end(), [&stem](const Vector2d& other) {
      return (other - stem).norm() < 1.7;
    });
    if (crowded) continue;
    stems.push_back(stem);
    const double height = random.uniform(5.0, 11.0);
    const int clumps = stem.norm() < 14.0 ? 140 : 60;
    const double radius = random.uniform(0.08, 0.24);
    const double yaw = random.uniform(0.0, 2.0 * kPi);
    const Vector3d foot = onGround(scene, stem.x(), stem.y());
    place(scene, makeTree(height, radius, clumps, random), foot, yaw);
  }
}

void plantBushes(SceneDescription& scene, int count, double reach, pcrb::Random& random) {
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-reach, reach);
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    const double y = woodPath(x) + side * random.uniform(1.3, reach);
    const double radius = random.uniform(0.3, 1.0);
    place(scene, makeBush(radius, static_cast<int>(70.0 * radius), random), onGround(scene, x, y));
  }
}

/// Rocks of a square: two in three lie in heaps, many are small and few large.
void scatterRocks(SceneDescription& scene, int count, double reach, pcrb::Random& random) {
  constexpr int kHeap = 12;           // rocks around one spot
  constexpr double kHeapReach = 3.0;  // m
  const Vector3d corner(reach, reach, 0.0);
  Vector3d heap = Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    if (i % kHeap == 0) heap = (1.0 - kHeapReach / reach) * drawBetween(-corner, corner, random);
    const Vector3d alone = drawBetween(-corner, corner, random);
    const Vector3d near = heap + kHeapReach * drawInBall(random);
    const Vector3d& spot = i % 3 == 0 ? alone : near;
    const double size = 0.16 * std::pow(1.0 - random.uniform(), -0.55);
    const double yaw = random.uniform(0.0, 2.0 * kPi);
    const Prop rock = makeRock(std::min(size, 1.8), random);
    place(scene, rock, onGround(scene, spot.x(), spot.y()), yaw);
  }
}

void layStreet(SceneDescription& scene) {
  const auto slab = [&scene](double y, double width, double top, const Surface& surface) {
    scene.shapes.push_back(makeBox({50.0, y, top - 0.5}, {200.0, width, 1.0}, surface));
  };
  slab(0.0, 9.0, 0.0, kAsphalt);
  for (const double side : {-1.0, 1.0}) {
    slab(side * 5.6, 2.2, 0.13, kPavement);
    slab(side * 26.7, 40.0, 0.10, kGrass);
  }
}

void buildHouses(SceneDescription& scene, double side, pcrb::Random& random) {
  double x = kStreetBegin;
  while (x < kStreetEnd) {
    // Depth, width and height of the house.
    const Vector3d size = drawBetween({8.0, 9.0, 3.2}, {10.0, 15.0, 6.6}, random);
    const double setback = random.uniform(8.6, 10.5);
    const Surface& wall = random.uniform() < 0.4 ? kBrick : kRender;
    place(scene, makeHouse(size.x(), size.y(), size.z(), wall),
          {x + 0.5 * size.y(), side * setback, 0.1}, -0.5 * kPi * side);
    const double gap = random.uniform(2.0, 5.0);
    scene.shapes.push_back(
        makeBox({x + size.y() + 0.5 * gap, side * 8.2, 0.8}, {gap, 0.08, 1.4}, kWood));
    x += size.y() + gap;
  }
}

/// Places along the street, at random distances from each other.
std::vector<double> alongStreet(double least, double most, pcrb::Random& random) {
  std::vector<double> places{kStreetBegin + random.uniform(0.0, most)};
  while (places.back() < kStreetEnd) places.push_back(places.back() + random.uniform(least, most));
  return places;
}

void addLamp(SceneDescription& scene, double x, double side) {
  const Vector3d foot(x, side * 4.8, 0.13);
  const Vector3d top = foot + Vector3d(0.0, 0.0, 5.95);
  scene.shapes.push_back(makeColumn(foot, 0.07, 6.0, kSteel));
  scene.shapes.push_back(makeRod(top, top + Vector3d(0.0, -1.4 * side, 0.2), 0.05, kSteel));
}

void lineStreet(SceneDescription& scene, double side, pcrb::Random& random) {
  const Surface paints[] = {kSilverPaint, kRedPaint, kDarkPaint, kWhitePaint};
  for (const double x : alongStreet(6.0, 14.0, random)) {
    const double yaw = random.uniform(-0.04, 0.04) + (side < 0.0 ? 0.0 : kPi);
    const double y = side * random.uniform(3.4, 3.6);
    place(scene, makeCar(paints[random.below(4)]), {x, y, 0.0}, yaw);
  }
  for (const double x : alongStreet(9.0, 14.0, random)) {
    const double height = random.uniform(5.0, 7.5);
    const double radius = random.uniform(0.10, 0.18);
    place(scene, makeTree(height, radius, 120, random), {x, side * 6.4, 0.1});
  }
  for (const double x : alongStreet(22.0, 24.0, random)) addLamp(scene, x, side);
  for (const double x : alongStreet(10.0, 20.0, random)) {
    const double radius = random.uniform(0.5, 0.9);
    place(scene, makeBush(radius, 60, random), {x, side * 7.4, 0.1});
  }
}

}  // namespace

double woodPath(double x) { return 1.4 * std::sin(x / 5.0); }

SceneDescription describeWood(std::uint64_t seed) {
  pcrb::Random random = makeStream(seed, "wood scene");
  const std::uint64_t lattice = random.bits();
  SceneDescription scene;
  scene.ground.emplace(32.0, 0.12, kForestFloor, [lattice](double x, double y) {
    return 0.9 * fractalNoise(x, y, lattice, 14.0, 3, 0.4) +
           0.06 * fractalNoise(x, y, lattice + 100, 0.9, 2, 0.6) + 0.03 * x;
  });
  plantTrees(scene, 170, 26.0, random);
  plantBushes(scene, 60, 16.0, random);
  const auto log_end = [&scene](double x, double y) {
    return Vector3d(onGround(scene, x, y) + Vector3d(0.0, 0.0, 0.15));
  };
  scene.shapes.push_back(makeRod(log_end(2.0, 4.0), log_end(5.5, 3.2), 0.20, kBark));
  scene.shapes.push_back(makeRod(log_end(-5.0, -3.4), log_end(-2.2, -4.6), 0.16, kBark));
  const Vector3d from = onGround(scene, -6.0, woodPath(-6.0) + 1.0);
  const Vector3d to = onGround(scene, 3.0, woodPath(3.0) + 1.0);
  scene.bodies.push_back({makePerson(kRedFabric), walkBetween(from, to, 1.1, 0.0)});
  return scene;
}

SceneDescription describeSandYard(std::uint64_t seed) {
  constexpr double kReach = 45.0;
  pcrb::Random random = makeStream(seed, "sand yard scene");
  const std::uint64_t lattice = random.bits();
  SceneDescription scene;
  scene.ground.emplace(kReach, 0.15, kSand, [lattice](double x, double y) {
    const double ripples = 0.02 * fractalNoise(x, 3.0 * y, lattice + 100, 1.1, 2, 0.7);
    const double craters = craterHeight({x - 9.0, y - 5.0}, 4.5, lattice + 200) +
                           craterHeight({x + 8.0, y - 9.0}, 3.0, lattice + 201) +
                           craterHeight({x + 3.0, y + 10.0}, 3.8, lattice + 202);
    return 1.3 * fractalNoise(x, y, lattice, 16.0, 4, 0.38) + craters + ripples;
  });
  scatterRocks(scene, 520, 20.0, random);
  scatterRocks(scene, 180, kReach - 1.0, random);
  return scene;
}

SceneDescription describeStreet(std::uint64_t seed) {
  pcrb::Random random = makeStream(seed, "street scene");
  SceneDescription scene;
  layStreet(scene);
  for (const double side : {-1.0, 1.0}) {
    buildHouses(scene, side, random);
    lineStreet(scene, side, random);
  }
  const auto drive = [](double start, double y, double speed) -> Motion {
    return [=](double time) {
      return atPlace({start + speed * time, y, 0.0}, speed < 0.0 ? kPi : 0.0);
    };
  };
  scene.bodies.push_back({makeCar(kRedPaint), drive(62.0, 1.3, -7.0)});
  scene.bodies.push_back({makeCar(kSilverPaint), drive(16.0, -1.2, 5.0)});
  scene.bodies.push_back(
      {makePerson(kBlueFabric), walkBetween({0.0, -5.4, 0.13}, {30.0, -5.4, 0.13}, 1.3, 6.0)});
  scene.bodies.push_back(
      {makePerson(kRedFabric), walkBetween({20.0, 5.3, 0.13}, {2.0, 5.3, 0.13}, 1.2, 0.0)});
  return scene;
}

}  // namespace pcrb_tools::simulation
