#include <cmath>

#include "pcrb_tools/simulation/props.hpp"
#include "pcrb_tools/simulation/surfaces.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.141592653589793;

/// Clumps of leaves at random places of an ellipsoid, denser to its outside, where light is.
void addLeaves(Prop& prop, const Vector3d& center, const Vector3d& radii, int clumps,
               const Surface& leaf, pcrb::Random& random) {
  for (int i = 0; i < clumps; ++i) {
    const Vector3d place = std::sqrt(random.uniform()) * random.direction();
    const double size = random.uniform(0.06, 0.20);
    prop.push_back(makeEllipsoid(center + place.cwiseProduct(radii), {size, 0.7 * size, 0.4 * size},
                                 leaf, random.uniform(0.0, kPi)));
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
  const Vector3d top(random.uniform(-0.06, 0.06) * height, random.uniform(-0.06, 0.06) * height,
                     height);
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
    const Vector3d extent(random.uniform(0.6, 1.0) * size, random.uniform(0.5, 0.8) * size,
                          random.uniform(0.4, 0.7) * size);
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
  Prop house{makeBox({-0.5 * depth, 0.0, 0.5 * height}, {depth, width, height}, wall),
             makeBox({0.03, 0.3 * width, 1.05}, {0.08, 1.0, 2.1}, kWood),
             makeBox({0.5, 0.3 * width, 2.35}, {1.2, 1.6, 0.10}, kRender),
             makeBox({0.35, 0.3 * width, 0.10}, {0.7, 1.4, 0.20}, kPavement)};
  for (double floor = 0.0; floor + 2.6 < height; floor += 2.8) {
    for (double y = 1.2 - 0.5 * width; y < 0.5 * width - 1.0; y += 2.4) {
      if (floor == 0.0 && std::abs(y - 0.3 * width) < 1.4) continue;  // the door is there
      const Vector3d window(0.0, y, floor + 1.6);
      house.push_back(makeBox(window + Vector3d(0.02, 0.0, 0.0), {0.06, 1.0, 1.2}, kGlass));
      house.push_back(makeBox(window + Vector3d(0.10, 0.0, -0.65), {0.22, 1.3, 0.08}, kPavement));
      house.push_back(makeBox(window + Vector3d(0.06, -0.75, 0.0), {0.06, 0.45, 1.25}, kWood));
      house.push_back(makeBox(window + Vector3d(0.06, 0.75, 0.0), {0.06, 0.45, 1.25}, kWood));
    }
  }
  const double slope = 0.6;
  const double half = 0.5 * depth + 0.4;
  const double length = half / std::cos(slope);
  const double ridge = height + 0.5 * half * std::tan(slope) - 0.1;
  house.push_back(makeBox({-0.5 * depth + 0.5 * half, 0.0, ridge}, {length, width + 0.6, 0.15},
                          kRoofTile, 0.0, slope));
  house.push_back(makeBox({-0.5 * depth - 0.5 * half, 0.0, ridge}, {length, width + 0.6, 0.15},
                          kRoofTile, 0.0, -slope));
  return house;
}

}  // namespace pcrb_tools::simulation
