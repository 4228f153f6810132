#include <cmath>

#include "simulation/noise.hpp"
#include "simulation/props.hpp"
#include "simulation/surfaces.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;

/// Clumps of leaves at random places of an ellipsoid, denser to its outside, where light is.
void addLeaves(Prop& prop, const Vector3d& center, const Vector3d& radii, int clumps,
               const Surface& leaf, pcrb::Random& random) {
  for (int i = 0; i < clumps; ++i) {
    const Vector3d place = drawInBall(random);
    const double size = random.uniform(0.06, 0.20);
    prop.push_back(makeEllipsoid(center + place.cwiseProduct(radii), {size, 0.7 * size, 0.4 * size},
                                 leaf, random.uniform(0.0, kPi)));
  }
}

/// Pane, sill and open shutters in a front that looks along x.
void addWindow(Prop& house, const Vector3d& center) {
  house.push_back(makeBox(center + Vector3d(0.02, 0.0, 0.0), {0.06, 1.0, 1.2}, kGlass));
  house.push_back(makeBox(center + Vector3d(0.10, 0.0, -0.65), {0.22, 1.3, 0.08}, kPavement));
  house.push_back(makeBox(center + Vector3d(0.06, -0.75, 0.0), {0.06, 0.45, 1.25}, kWood));
  house.push_back(makeBox(center + Vector3d(0.06, 0.75, 0.0), {0.06, 0.45, 1.25}, kWood));
}

/// Two slopes that meet above the middle of the house.
void addRoof(Prop& house, double depth, double width, double height) {
  constexpr double kSlope = 0.6;  // rad
  const double half = 0.5 * depth + 0.4;
  const Vector3d size(half / std::cos(kSlope), width + 0.6, 0.15);
  const double middle = height + 0.5 * half * std::tan(kSlope) - 0.1;
  for (const double side : {-1.0, 1.0}) {
    house.push_back(
        makeBox({0.5 * (side * half - depth), 0.0, middle}, size, kRoofTile, 0.0, side * kSlope));
  }
}

}  // namespace

Prop makePerson(const Surface& clothes) {
  return {makeRod({0.10, -0.10, 0.03}, {0.0, -0.09, 0.85}, 0.08, kDarkPaint),
          makeRod({-0.12, 0.10, 0.03}, {0.0, 0.09, 0.85}, 0.08, kDarkPaint),
          makeEllipsoid({0.0, 0.0, 1.13}, {0.15, 0.22, 0.36}, clothes),
          makeRod({0.0, -0.24, 1.38}, {0.12, -0.28, 0.85}, 0.05, clothes),
          makeRod({0.0, 0.24, 1.38}, {-0.12, 0.28, 0.85}, 0.05, clothes),
          makeColumn({0.0, 0.0, 1.42}, 0.06, 0.12, kSkin),
          makeEllipsoid({0.0, 0.0, 1.63}, {0.10, 0.08, 0.13}, kSkin)};
}

Prop makeTree(double height, double stem_radius, int clumps, pcrb::Random& random) {
  const Vector3d top = height * drawBetween({-0.06, -0.06, 1.0}, {0.06, 0.06, 1.0}, random);
  Prop tree{makeRod({0.0, 0.0, -0.3}, 0.5 * top, stem_radius, kBark),
            makeRod(0.5 * top, top, 0.6 * stem_radius, kBark)};
  const int branches = 5 + static_cast<int>(random.below(6));
  for (int i = 0; i < branches; ++i) {
    const Vector3d root = random.uniform(0.25, 0.85) * top;
    const double azimuth = random.uniform(0.0, 2.0 * kPi);
    const Vector3d reach(std::cos(azimuth), std::sin(azimuth), random.uniform(0.1, 0.7));
    tree.push_back(
        makeRod(root, root + random.uniform(0.6, 1.8) * reach, 0.2 * stem_radius + 0.01, kBark));
  }
  const Surface leaf = random.uniform() < 0.3 ? kAutumnLeaf : kLeaf;
  const Vector3d crown(0.22 * height, 0.22 * height, 0.30 * height);
  addLeaves(tree, 0.72 * top, crown, clumps, leaf, random);
  return tree;
}

Prop makeBush(double radius, int clumps, pcrb::Random& random) {
  Prop bush;
  addLeaves(bush, {0.0, 0.0, 0.5 * radius}, {radius, radius, 0.7 * radius}, clumps, kLeaf, random);
  return bush;
}

Prop makeRock(double size, pcrb::Random& random) {
  Prop rock;
  for (int lump = 0; lump < 3; ++lump) {
    const Vector3d center = 0.22 * size * random.direction();
    const Vector3d extent = size * drawBetween({0.6, 0.5, 0.4}, {1.0, 0.8, 0.7}, random);
    Shape shape = lump == 0 ? makeBox(center, 0.85 * extent, kRock)
                            : makeEllipsoid(center, 0.5 * extent, kRock);
    shape.T_world_shape.rotate(random.rotation());
    rock.push_back(shape);
  }
  return rock;
}

Prop makeCar(const Surface& paint) {
  Prop car{makeBox({0.0, 0.0, 0.62}, {4.3, 1.75, 0.55}, paint),
           makeBox({-0.25, 0.0, 1.12}, {2.0, 1.50, 0.46}, kGlass),
           makeBox({-0.25, 0.0, 1.38}, {1.9, 1.45, 0.08}, paint),
           makeBox({1.05, 0.0, 1.02}, {0.95, 1.45, 0.06}, kGlass, 0.0, 0.50),
           makeBox({-1.45, 0.0, 1.06}, {0.70, 1.45, 0.06}, paint, 0.0, -0.70)};
  for (const double y : {-0.71, 0.71}) {
    car.push_back(makeRod({0.70, y, 0.90}, {0.45, y, 1.36}, 0.05, paint));
    car.push_back(makeRod({-0.45, y, 0.90}, {-0.45, y, 1.36}, 0.05, paint));
    car.push_back(makeRod({-1.25, y, 0.90}, {-1.15, y, 1.36}, 0.06, paint));
  }
  for (const double x : {-1.35, 1.35}) {
    for (const double y : {-0.80, 0.80}) {
      car.push_back(makeRod({x, y - 0.1, 0.32}, {x, y + 0.1, 0.32}, 0.32, kRubber));
    }
  }
  return car;
}

Prop makeHouse(double depth, double width, double height, const Surface& wall) {
  const double door = 0.3 * width;
  Prop house{makeBox({-0.5 * depth, 0.0, 0.5 * height}, {depth, width, height}, wall),
             makeBox({0.03, door, 1.05}, {0.08, 1.0, 2.1}, kWood),
             makeBox({0.5, door, 2.35}, {1.2, 1.6, 0.10}, kRender),
             makeBox({0.35, door, 0.10}, {0.7, 1.4, 0.20}, kPavement)};
  const int floors = 1 + static_cast<int>((height - 2.6) / 2.8);
  const int windows = static_cast<int>((width - 2.2) / 2.4) + 1;
  for (int floor = 0; floor < floors; ++floor) {
    for (int window = 0; window < windows; ++window) {
      const double y = 1.2 - 0.5 * width + 2.4 * window;
      const bool at_door = floor == 0 && std::abs(y - door) < 1.4;
      if (!at_door) addWindow(house, {0.0, y, 2.8 * floor + 1.6});
    }
  }
  addRoof(house, depth, width, height);
  return house;
}

}  // namespace pcrb_tools::simulation
