#include <vector>

#include "simulation/noise.hpp"
#include "simulation/props.hpp"
#include "simulation/surfaces.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWallThickness = 0.12;

/// Door or window: part of a wall, from its start, with what is left below and above; m.
struct Opening {
  double begin;
  double end;
  double sill;
  double lintel;
};

constexpr double kDoor = 2.05;

/// Wall between two points of the floor plan, with openings in the order of the wall.
void addWall(SceneDescription& scene, const Vector2d& from, const Vector2d& to, double height,
             const std::vector<Opening>& openings = {}) {
  const Vector2d along = (to - from).normalized();
  const double yaw = std::atan2(along.y(), along.x());
  const auto panel = [&](double begin, double end, double bottom, double top) {
    if (end <= begin || top <= bottom) return;
    const Vector2d middle = from + 0.5 * (begin + end) * along;
    scene.shapes.push_back(makeBox({middle.x(), middle.y(), 0.5 * (bottom + top)},
                                   {end - begin, kWallThickness, top - bottom}, kPlaster, yaw));
  };
  double solid_from = 0.0;
  for (const Opening& opening : openings) {
    panel(solid_from, opening.begin, 0.0, height);
    panel(opening.begin, opening.end, 0.0, opening.sill);
    panel(opening.begin, opening.end, opening.lintel, height);
    if (opening.sill > 0.0) {
      const Vector2d middle = from + 0.5 * (opening.begin + opening.end) * along;
      const double tall = opening.lintel - opening.sill;
      const Vector3d center(middle.x(), middle.y(), opening.sill + 0.5 * tall);
      scene.shapes.push_back(
          makeBox(center, {opening.end - opening.begin, 0.02, tall}, kGlass, yaw));
      scene.shapes.push_back(makeBox(center, {0.06, 0.07, tall}, kWhitePaint, yaw));
    }
    solid_from = opening.end;
  }
  panel(solid_from, (to - from).norm(), 0.0, height);
}

void addFloorAndCeiling(SceneDescription& scene, const Vector2d& low, const Vector2d& high,
                        double height, const Surface& floor) {
  const Vector2d center = 0.5 * (low + high);
  const Vector2d size = high - low;
  scene.shapes.push_back(makeBox({center.x(), center.y(), -0.1}, {size.x(), size.y(), 0.2}, floor));
  scene.shapes.push_back(
      makeBox({center.x(), center.y(), height + 0.1}, {size.x(), size.y(), 0.2}, kCeiling));
}

void furnishLivingRoom(SceneDescription& scene, pcrb::Random& random) {
  place(scene, makeTable(1.6, 0.9, 0.75, kLightWood), {2.9, 5.1, 0.0}, 0.1);
  place(scene, makeChair(kWood), {2.5, 4.4, 0.0}, 1.7);
  place(scene, makeChair(kWood), {3.3, 4.35, 0.0}, 1.3);
  place(scene, makeChair(kWood), {2.6, 5.8, 0.0}, -1.5);
  place(scene, makeChair(kWood), {4.0, 5.2, 0.0}, 3.0);
  place(scene, makeClutter(1.3, 0.7, 7, random), {2.9, 5.1, 0.75}, 0.1);
  place(scene, makeSofa(kRedFabric), {0.55, 2.2, 0.0});
  place(scene, makeTable(0.9, 0.5, 0.42, kWood), {1.75, 2.2, 0.0}, 0.5 * kPi);
  place(scene, makeBookshelf(1.2, 2.1, random), {4.76, 1.2, 0.0}, kPi);
  place(scene, makeCupboard(1.4, 0.45, 0.6, kLightWood), {2.6, 0.3, 0.0}, 0.5 * kPi);
  place(scene, makeMonitor(), {2.6, 0.3, 0.6}, 0.5 * kPi);
  place(scene, makePottedPlant(random), {0.45, 0.5, 0.0});
  place(scene, makePottedPlant(random), {4.6, 6.55, 0.0});
  place(scene, makeCupboard(2.4, 0.6, 0.9, kWhitePaint), {1.3, 6.62, 0.0}, -0.5 * kPi);
  place(scene, makeCupboard(2.4, 0.35, 0.7, kWhitePaint), {1.3, 6.75, 1.45}, -0.5 * kPi);
  place(scene, makeClutter(2.0, 0.4, 6, random), {1.3, 6.62, 0.9});
  place(scene, makeCupboard(0.65, 0.65, 1.85, kSteel), {2.9, 6.6, 0.0}, -0.5 * kPi);
}

void furnishOtherRooms(SceneDescription& scene, pcrb::Random& random) {
  place(scene, makeCupboard(0.9, 0.35, 1.0, kWood), {5.25, 6.2, 0.0});
  place(scene, makeBookshelf(0.9, 1.9, random), {5.6, 0.25, 0.0}, 0.5 * kPi);
  place(scene, makeBed(), {8.3, 5.6, 0.0}, kPi);
  place(scene, makeCupboard(1.5, 0.6, 2.1, kLightWood), {7.4, 3.6, 0.0}, 0.5 * kPi);
  place(scene, makeTable(0.5, 0.45, 0.5, kWood), {9.15, 4.5, 0.0});
  place(scene, makeLamp(), {9.15, 4.5, 0.5}, 2.0);
  place(scene, makeCupboard(0.8, 0.5, 0.85, kWhitePaint), {9.15, 2.2, 0.0}, kPi);
  scene.shapes.push_back(makeBox({8.6, 0.5, 0.28}, {1.7, 0.75, 0.56}, kWhitePaint));
  scene.shapes.push_back(makeEllipsoid({7.0, 0.45, 0.22}, {0.20, 0.28, 0.22}, kWhitePaint));
}

}  // namespace

SceneDescription describeApartment(std::uint64_t seed) {
  constexpr double kHeight = 2.5;
  pcrb::Random random = makeStream(seed, "apartment scene");
  SceneDescription scene;
  addFloorAndCeiling(scene, {-0.1, -0.1}, {9.7, 7.1}, kHeight, kParquet);
  addWall(scene, {0.0, 0.0}, {9.6, 0.0}, kHeight, {{0.9, 1.9, 0.9, 2.2}, {7.6, 8.2, 1.4, 2.2}});
  addWall(scene, {9.6, 0.0}, {9.6, 7.0}, kHeight, {{4.6, 5.9, 0.9, 2.2}});
  addWall(scene, {9.6, 7.0}, {0.0, 7.0}, kHeight, {{3.4, 4.2, 0.0, kDoor}, {5.0, 6.1, 0.9, 2.2}});
  addWall(scene, {0.0, 7.0}, {0.0, 0.0}, kHeight, {{2.0, 3.6, 0.2, 2.2}});
  addWall(scene, {5.0, 0.0}, {5.0, 7.0}, kHeight, {{2.5, 3.5, 0.0, kDoor}});
  addWall(scene, {6.3, 0.0}, {6.3, 7.0}, kHeight, {{1.6, 2.4, 0.0, kDoor}, {4.1, 5.0, 0.0, kDoor}});
  addWall(scene, {6.3, 3.2}, {9.6, 3.2}, kHeight);
  scene.shapes.push_back(makeBox({4.62, 2.48, 1.02}, {0.9, 0.04, 2.04}, kWhitePaint, 0.25));
  scene.shapes.push_back(makeBox({6.7, 4.02, 1.02}, {0.9, 0.04, 2.04}, kWhitePaint, 0.15));
  furnishLivingRoom(scene, random);
  furnishOtherRooms(scene, random);
  scene.bodies.push_back(
      {makePerson(kBlueFabric), walkBetween({1.0, 4.0, 0.0}, {1.3, 5.9, 0.0}, 0.7, 0.0)});
  scene.bodies.push_back(
      {makePerson(kRedFabric), walkBetween({5.6, 0.9, 0.0}, {5.7, 2.3, 0.0}, 0.5, 2.0)});
  return scene;
}

SceneDescription describeOffice(std::uint64_t seed) {
  constexpr double kHeight = 2.8;
  pcrb::Random random = makeStream(seed, "office scene");
  SceneDescription scene;
  addFloorAndCeiling(scene, {-4.6, -3.1}, {4.6, 3.1}, kHeight, kCarpet);
  addWall(scene, {-4.5, -3.0}, {4.5, -3.0}, kHeight, {{1.5, 3.2, 0.9, 2.2}, {5.5, 7.2, 0.9, 2.2}});
  addWall(scene, {4.5, -3.0}, {4.5, 3.0}, kHeight, {{0.8, 1.7, 0.0, kDoor}});
  addWall(scene, {4.5, 3.0}, {-4.5, 3.0}, kHeight);
  addWall(scene, {-4.5, 3.0}, {-4.5, -3.0}, kHeight);
  for (const double side : {-1.0, 1.0}) {
    const double front = side < 0.0 ? -0.5 * kPi : 0.5 * kPi;
    place(scene, makeTable(1.8, 0.8, 0.72, side < 0.0 ? kLightWood : kWhitePaint),
          {0.0, 0.43 * side, 0.0});
    place(scene, makeMonitor(), {-0.35 * side, 0.2 * side, 0.72}, front + 0.15);
    place(scene, makeLamp(), {0.65 * side, 0.15 * side, 0.72}, front);
    place(scene, makeClutter(1.6, 0.55, 16, random), {0.0, 0.45 * side, 0.72});
    place(scene, makeChair(kBlueFabric), {0.3 * side, 0.9 * side, 0.0}, -front + 0.3);
  }
  scene.shapes.push_back(makeBox({0.0, 0.0, 0.85}, {1.7, 0.03, 0.5}, kGreyFabric));
  place(scene, makeTeddyBear(), {0.68, -0.28, 0.72}, -1.9);
  place(scene, makePottedPlant(random), {1.25, 0.2, 0.0});
  place(scene, makeClutter(0.6, 0.9, 5, random), {-1.35, 0.1, 0.0});
  place(scene, makeCupboard(0.45, 0.6, 0.6, kSteel), {-1.25, -0.45, 0.0}, -1.3);
  for (const double x : {-3.6, -2.3, -0.9, 0.6, 2.0, 3.4}) {
    const double height = random.uniform(1.5, 2.1);
    place(scene, makeBookshelf(1.2, height, random), {x, 2.76, 0.0}, -0.5 * kPi);
  }
  place(scene, makeClutter(5.0, 0.5, 14, random), {-0.3, 2.25, 0.0});
  place(scene, makeTable(1.6, 0.7, 0.72, kLightWood), {-2.6, -2.55, 0.0});
  place(scene, makeClutter(1.4, 0.5, 9, random), {-2.6, -2.55, 0.72});
  place(scene, makeTable(1.6, 0.7, 0.72, kLightWood), {1.6, -2.55, 0.0});
  place(scene, makeMonitor(), {1.6, -2.7, 0.72}, 0.5 * kPi);
  place(scene, makeClutter(1.4, 0.4, 7, random), {1.6, -2.5, 0.72});
  place(scene, makeCupboard(1.2, 0.45, 1.3, kWood), {4.2, 1.6, 0.0}, kPi);
  place(scene, makePottedPlant(random), {-4.1, -2.5, 0.0});
  return scene;
}

}  // namespace pcrb_tools::simulation
