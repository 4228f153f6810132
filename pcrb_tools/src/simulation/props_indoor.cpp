#include <algorithm>
#include <vector>

#include "simulation/noise.hpp"
#include "simulation/props.hpp"
#include "simulation/surfaces.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;

/// Four legs below a plate of a size, `inset` from its edges.
void addLegs(Prop& prop, double length, double width, double height, double inset, double radius,
             const Surface& surface) {
  for (const double x : {inset - 0.5 * length, 0.5 * length - inset}) {
    for (const double y : {inset - 0.5 * width, 0.5 * width - inset}) {
      prop.push_back(makeColumn({x, y, 0.0}, radius, height, surface));
    }
  }
}

Surface randomCover(pcrb::Random& random) {
  const float grey = static_cast<float>(random.uniform(0.15, 0.75));
  const Eigen::Vector3d tint =
      drawBetween(Vector3d::Constant(-0.14), Vector3d::Constant(0.20), random);
  const Eigen::Vector3f color = tint.cast<float>().array() + grey;
  return {color, 0.25F + 0.5F * color.x()};
}

/// One thing of those that lie about: cup, bottle, books, box or ball.
Prop makeThing(pcrb::Random& random) {
  const double yaw = random.uniform(0.0, kPi);
  const Surface cover = randomCover(random);
  const auto box = [&](const Vector3d& low, const Vector3d& high) {
    const Vector3d size = drawBetween(low, high, random);
    return makeBox({0.0, 0.0, 0.5 * size.z()}, size, cover, yaw);
  };
  switch (random.below(5)) {
    case 0:
      return {makeColumn(Vector3d::Zero(), 0.04, 0.10, cover)};
    case 1:
      return {makeColumn(Vector3d::Zero(), 0.035, 0.18, cover),
              makeColumn({0.0, 0.0, 0.18}, 0.015, 0.07, cover)};
    case 2:
      return {box({0.16, 0.22, 0.01}, {0.16, 0.22, 0.06})};
    case 3:
      return {box({0.10, 0.10, 0.06}, {0.20, 0.20, 0.20})};
    default:
      return {makeEllipsoid({0.0, 0.0, 0.06}, {0.06, 0.06, 0.06}, cover)};
  }
}

/// A row of books on a board at a height, their backs to the front.
void addBooks(Prop& shelf, double board, double depth, double width, pcrb::Random& random) {
  const double end = 0.5 * width - random.uniform(0.05, 0.3);
  double y = 0.03 - 0.5 * width;
  while (y < end) {
    const double thickness = random.uniform(0.02, 0.06);
    const double tall = random.uniform(0.19, 0.31);
    const double deep = random.uniform(0.14, 0.24);
    shelf.push_back(makeBox({0.5 * (depth - deep) - 0.03, y + 0.5 * thickness, board + 0.5 * tall},
                            {deep, thickness * 0.94, tall}, randomCover(random)));
    y += thickness;
  }
}

}  // namespace

Prop makeTable(double length, double width, double height, const Surface& top) {
  Prop table{makeBox({0.0, 0.0, height - 0.015}, {length, width, 0.03}, top)};
  addLegs(table, length, width, height - 0.03, 0.06, 0.025, kSteel);
  return table;
}

Prop makeChair(const Surface& seat) {
  Prop chair{makeBox({0.0, 0.0, 0.45}, {0.44, 0.44, 0.05}, seat),
             makeBox({-0.20, 0.0, 0.78}, {0.04, 0.42, 0.36}, seat, 0.0, -0.12),
             makeRod({-0.19, -0.18, 0.45}, {-0.20, -0.18, 0.65}, 0.015, kSteel),
             makeRod({-0.19, 0.18, 0.45}, {-0.20, 0.18, 0.65}, 0.015, kSteel)};
  addLegs(chair, 0.42, 0.42, 0.43, 0.02, 0.018, kSteel);
  return chair;
}

Prop makeSofa(const Surface& fabric) {
  return {makeBox({0.0, 0.0, 0.22}, {0.85, 1.90, 0.32}, fabric),
          makeBox({-0.34, 0.0, 0.58}, {0.18, 1.90, 0.50}, fabric, 0.0, -0.15),
          makeBox({0.0, -0.97, 0.36}, {0.85, 0.16, 0.58}, fabric),
          makeBox({0.0, 0.97, 0.36}, {0.85, 0.16, 0.58}, fabric),
          makeEllipsoid({-0.15, -0.6, 0.52}, {0.10, 0.24, 0.20}, kBlueFabric),
          makeEllipsoid({-0.15, 0.55, 0.52}, {0.10, 0.22, 0.22}, kGreyFabric)};
}

Prop makeBed() {
  return {makeBox({0.0, 0.0, 0.25}, {2.05, 1.45, 0.30}, kWood),
          makeBox({0.0, 0.0, 0.47}, {1.95, 1.40, 0.14}, kWhitePaint),
          makeBox({-1.05, 0.0, 0.55}, {0.06, 1.50, 0.80}, kWood),
          makeEllipsoid({-0.72, -0.35, 0.58}, {0.22, 0.30, 0.09}, kWhitePaint),
          makeEllipsoid({-0.72, 0.35, 0.58}, {0.22, 0.30, 0.09}, kWhitePaint),
          makeEllipsoid({0.35, 0.0, 0.52}, {0.75, 0.72, 0.12}, kBlueFabric)};
}

Prop makeBookshelf(double width, double height, pcrb::Random& random) {
  const double depth = 0.30;
  Prop shelf{makeBox({0.0, -0.5 * width, 0.5 * height}, {depth, 0.025, height}, kLightWood),
             makeBox({0.0, 0.5 * width, 0.5 * height}, {depth, 0.025, height}, kLightWood),
             makeBox({-0.5 * depth, 0.0, 0.5 * height}, {0.01, width, height}, kLightWood)};
  constexpr double kFirstBoard = 0.05;
  constexpr double kBoardSpacing = 0.36;
  const int boards = 1 + static_cast<int>((height - kFirstBoard) / kBoardSpacing);
  for (int i = 0; i < boards; ++i) {
    const double board = kFirstBoard + kBoardSpacing * i;
    shelf.push_back(makeBox({0.0, 0.0, board}, {depth, width, 0.025}, kLightWood));
    if (i + 1 < boards) addBooks(shelf, board + 0.013, depth, width, random);
  }
  return shelf;
}

Prop makeCupboard(double width, double depth, double height, const Surface& surface) {
  const double front = 0.5 * depth;
  return {makeBox({0.0, 0.0, 0.5 * height}, {depth, width, height}, surface),
          makeBox({front + 0.01, -0.26 * width, 0.5 * height}, {0.02, 0.46 * width, 0.92 * height},
                  surface),
          makeBox({front + 0.01, 0.26 * width, 0.5 * height}, {0.02, 0.46 * width, 0.92 * height},
                  surface),
          makeRod({front + 0.05, -0.06, 0.45 * height}, {front + 0.05, -0.06, 0.58 * height}, 0.008,
                  kSteel),
          makeRod({front + 0.05, 0.06, 0.45 * height}, {front + 0.05, 0.06, 0.58 * height}, 0.008,
                  kSteel)};
}

Prop makeMonitor() {
  return {makeBox({0.0, 0.0, 0.34}, {0.05, 0.52, 0.34}, kBlackPlastic),
          makeBox({0.026, 0.0, 0.34}, {0.004, 0.48, 0.30}, kGlass),
          makeBox({-0.02, 0.0, 0.11}, {0.03, 0.08, 0.20}, kBlackPlastic),
          makeColumn({0.0, 0.0, 0.0}, 0.12, 0.02, kBlackPlastic),
          makeBox({0.30, 0.0, 0.015}, {0.16, 0.44, 0.025}, kGreyFabric),
          makeEllipsoid({0.30, -0.32, 0.015}, {0.05, 0.03, 0.02}, kBlackPlastic)};
}

Prop makeLamp() {
  return {makeColumn({0.0, 0.0, 0.0}, 0.09, 0.02, kSteel),
          makeRod({0.0, 0.0, 0.02}, {0.06, 0.0, 0.30}, 0.012, kSteel),
          makeRod({0.06, 0.0, 0.30}, {0.22, 0.0, 0.42}, 0.012, kSteel),
          makeEllipsoid({0.25, 0.0, 0.40}, {0.09, 0.09, 0.06}, kWhitePaint)};
}

Prop makePottedPlant(pcrb::Random& random) {
  Prop plant{makeColumn({0.0, 0.0, 0.0}, 0.14, 0.26, kBrick),
             makeColumn({0.0, 0.0, 0.26}, 0.015, 0.35, kBark)};
  for (int leaf = 0; leaf < 40; ++leaf) {
    const Vector3d center = Vector3d(0.0, 0.0, 0.72) + 0.32 * drawInBall(random);
    plant.push_back(makeEllipsoid(center, {0.09, 0.035, 0.02}, kLeaf, random.uniform(0.0, kPi)));
  }
  return plant;
}

Prop makeTeddyBear() {
  return {makeEllipsoid({0.0, 0.0, 0.20}, {0.14, 0.16, 0.20}, kTeddy),
          makeEllipsoid({0.02, 0.0, 0.47}, {0.12, 0.13, 0.12}, kTeddy),
          makeEllipsoid({0.13, 0.0, 0.44}, {0.06, 0.06, 0.05}, kLightWood),
          makeEllipsoid({0.0, -0.11, 0.57}, {0.03, 0.05, 0.05}, kTeddy),
          makeEllipsoid({0.0, 0.11, 0.57}, {0.03, 0.05, 0.05}, kTeddy),
          makeRod({0.05, -0.14, 0.30}, {0.20, -0.22, 0.18}, 0.05, kTeddy),
          makeRod({0.05, 0.14, 0.30}, {0.20, 0.22, 0.18}, 0.05, kTeddy),
          makeRod({0.08, -0.09, 0.07}, {0.32, -0.16, 0.06}, 0.06, kTeddy),
          makeRod({0.08, 0.09, 0.07}, {0.32, 0.16, 0.06}, 0.06, kTeddy)};
}

Prop makeClutter(double length, double width, int count, pcrb::Random& random) {
  const Vector3d corner(0.5 * length, 0.5 * width, 0.0);
  Prop clutter;
  std::vector<Vector3d> feet;
  for (int i = 0; i < count; ++i) {
    const Vector3d foot = drawBetween(-corner, corner, random);
    const bool crowded = std::any_of(feet.begin(), feet.end(), [&foot](const Vector3d& other) {
      return (other - foot).norm() < 0.19;
    });
    if (crowded) continue;
    feet.push_back(foot);
    for (Shape shape : makeThing(random)) {
      shape.T_world_shape.pretranslate(foot);
      clutter.push_back(shape);
    }
  }
  return clutter;
}

}  // namespace pcrb_tools::simulation
