#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "pcrb_core/random.hpp"
#include "simulation/height_field.hpp"
#include "simulation/props.hpp"
#include "simulation/scene.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;

const Surface kGrey{{0.5F, 0.5F, 0.5F}, 0.5F};
constexpr double kFar = 1e3;

Ray toward(const Vector3d& origin, const Vector3d& target) {
  return {origin, (target - origin).normalized()};
}

TEST(Shape, BoxIsHitAtItsFace) {
  const UnitSolid box(makeBox({5.0, 0.0, 0.0}, {2.0, 1.0, 1.0}, kGrey));
  const auto hit = box.intersect({{0.0, 0.2, 0.1}, Vector3d::UnitX()}, kFar);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 4.0, 1e-12);
  EXPECT_LT((hit->normal + Vector3d::UnitX()).norm(), 1e-12);
}

TEST(Shape, TurnedBoxIsHitAtItsEdge) {
  const UnitSolid box(makeBox({5.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, kGrey, 0.25 * M_PI));
  const auto hit = box.intersect({Vector3d::Zero(), Vector3d::UnitX()}, kFar);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 5.0 - std::sqrt(2.0), 1e-9);
}

TEST(Shape, EllipsoidIsHitAtItsPoleWithTheNormalThere) {
  const UnitSolid ball(makeEllipsoid({0.0, 0.0, 2.0}, {3.0, 2.0, 0.5}, kGrey));
  const auto hit = ball.intersect({{0.0, 0.0, 10.0}, -Vector3d::UnitZ()}, kFar);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 7.5, 1e-12);
  EXPECT_LT((hit->normal - Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(Shape, EllipsoidNormalIsTheGradientOfItsEquation) {
  const Vector3d radii(3.0, 2.0, 0.5);
  const UnitSolid ball(makeEllipsoid(Vector3d::Zero(), radii, kGrey));
  const Ray ray = toward({5.0, 4.0, 3.0}, {0.3, 0.2, 0.1});
  const auto hit = ball.intersect(ray, kFar);
  ASSERT_TRUE(hit);
  const Vector3d point = ray.origin + hit->distance * ray.direction;
  EXPECT_NEAR(point.cwiseQuotient(radii).squaredNorm(), 1.0, 1e-12);
  const Vector3d gradient = point.cwiseQuotient(radii.cwiseAbs2()).normalized();
  EXPECT_LT((hit->normal - gradient).norm(), 1e-12);
}

TEST(Shape, RodIsHitAtItsSideAndAtItsEnd) {
  const UnitSolid rod(makeRod({1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, 0.25, kGrey));
  const auto side = rod.intersect({{2.0, 5.0, 0.0}, -Vector3d::UnitY()}, kFar);
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->distance, 4.75, 1e-12);
  const auto end = rod.intersect({{9.0, 0.1, 0.1}, -Vector3d::UnitX()}, kFar);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->distance, 6.0, 1e-12);
  EXPECT_LT((end->normal - Vector3d::UnitX()).norm(), 1e-9);
}

TEST(Shape, IsNotSeenBesideBehindFromInsideOrBeyondTheLimit) {
  for (const Shape& shape : {makeBox({5.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, kGrey),
                             makeColumn({5.0, 0.0, -1.0}, 1.0, 2.0, kGrey),
                             makeEllipsoid({5.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, kGrey)}) {
    const UnitSolid solid(shape);
    EXPECT_FALSE(solid.intersect({{0.0, 1.5, 0.0}, Vector3d::UnitX()}, kFar));
    EXPECT_FALSE(solid.intersect({Vector3d::Zero(), -Vector3d::UnitX()}, kFar));
    EXPECT_FALSE(solid.intersect({{5.0, 0.0, 0.0}, Vector3d::UnitX()}, kFar));
    EXPECT_FALSE(solid.intersect({Vector3d::Zero(), Vector3d::UnitX()}, 3.9));
    EXPECT_TRUE(solid.intersect({Vector3d::Zero(), Vector3d::UnitX()}, 4.1));
  }
}

std::vector<Shape> randomShapes(int count, pcrb::Random& random) {
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) {
    Shape shape = makeBox(10.0 * random.uniform() * random.direction(),
                          {random.uniform(0.1, 2.0), random.uniform(0.1, 2.0), 0.5}, kGrey);
    shape.kind = static_cast<Shape::Kind>(random.below(3));
    shape.T_world_shape.rotate(random.rotation());
    shapes.push_back(shape);
  }
  return shapes;
}

TEST(Bvh, FindsWhatTryingEveryShapeFinds) {
  pcrb::Random random(3);
  const std::vector<Shape> shapes = randomShapes(300, random);
  const Bvh bvh(shapes);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = toward(20.0 * random.direction(), 8.0 * random.direction());
    std::optional<Hit> nearest;
    for (const Shape& shape : shapes) {
      const auto hit = UnitSolid(shape).intersect(ray, nearest ? nearest->distance : kFar);
      if (hit) nearest = hit;
    }
    const auto found = bvh.intersect(ray, kFar);
    ASSERT_EQ(found.has_value(), nearest.has_value()) << "ray " << i;
    if (!found) continue;
    ++hits;
    EXPECT_DOUBLE_EQ(found->distance, nearest->distance) << "ray " << i;
  }
  EXPECT_GT(hits, 500);
}

TEST(Bvh, OfNothingIsNeverHit) {
  EXPECT_FALSE(Bvh({}).intersect({Vector3d::Zero(), Vector3d::UnitX()}, kFar));
}

TEST(HeightField, SlopeIsHitWhereItsPlaneIs) {
  const HeightField slope(20.0, 0.3, kGrey, [](double x, double y) { return 0.2 * x - 0.1 * y; });
  const Ray ray = toward({-3.0, 4.0, 6.0}, {7.0, 5.0, 0.9});
  const auto hit = slope.intersect(ray, kFar);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, (Vector3d(7.0, 5.0, 0.9) - ray.origin).norm(), 1e-5);
  EXPECT_LT((hit->normal - Vector3d(-0.2, 0.1, 1.0).normalized()).norm(), 1e-5);
}

TEST(HeightField, NoRayEndsBelowOrSkipsAHill) {
  const HeightField hills(15.0, 0.2, kGrey,
                          [](double x, double y) { return fractalNoise(x, y, 7, 4.0, 3, 0.5); });
  pcrb::Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Vector3d origin(random.uniform(-14.0, 14.0), random.uniform(-14.0, 14.0), 3.0);
    const Ray ray =
        toward(origin, {random.uniform(-14.0, 14.0), random.uniform(-14.0, 14.0), -1.0});
    const auto hit = hills.intersect(ray, kFar);
    ASSERT_TRUE(hit);
    const Vector3d end = origin + hit->distance * ray.direction;
    EXPECT_NEAR(end.z(), hills.height(end.x(), end.y()), 1e-6) << "ray " << i;
    for (double t = 0.0; t < hit->distance - 0.01; t += 0.02) {
      const Vector3d point = origin + t * ray.direction;
      ASSERT_GT(point.z(), hills.height(point.x(), point.y()) - 1e-6) << "ray " << i;
    }
  }
}

TEST(HeightField, StraightDownMeetsTheHeight) {
  const HeightField hills(5.0, 0.25, kGrey, [](double x, double y) { return std::sin(x) * y; });
  for (const double x : {-4.9, -1.2, 0.0, 0.25, 3.3}) {
    const auto hit = hills.intersect({{x, 1.7, 10.0}, -Vector3d::UnitZ()}, kFar);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(10.0 - hit->distance, hills.height(x, 1.7), 1e-9);
  }
}

TEST(HeightField, EndsAtItsBorder) {
  const HeightField flat(5.0, 0.5, kGrey, [](double, double) { return 0.0; });
  EXPECT_TRUE(flat.intersect({{4.9, 0.0, 1.0}, -Vector3d::UnitZ()}, kFar));
  EXPECT_FALSE(flat.intersect({{5.1, 0.0, 1.0}, -Vector3d::UnitZ()}, kFar));
}

TEST(Scene, NearestOfGroundThingsAndBodiesIsSeen) {
  SceneDescription description;
  description.ground.emplace(50.0, 1.0, kGrey, [](double, double) { return 0.0; });
  description.shapes.push_back(makeBox({8.0, 0.0, 1.0}, {2.0, 2.0, 2.0}, kGrey));
  description.bodies.push_back({{makeBox({0.0, 0.0, 1.0}, {0.4, 0.4, 2.0}, kGrey)},
                                walkBetween({4.0, -3.0, 0.0}, {4.0, 3.0, 0.0}, 1.0, 0.0)});
  const Scene scene(description);
  const Ray ahead{{0.0, 0.0, 1.0}, Vector3d::UnitX()};
  EXPECT_NEAR(scene.at(0.0).cast(ahead, kFar)->distance, 7.0, 1e-9);
  EXPECT_NEAR(scene.at(3.0).cast(ahead, kFar)->distance, 3.8, 1e-9);
  EXPECT_NEAR(scene.at(9.0).cast(ahead, kFar)->distance, 3.8, 1e-9) << "on the way back";
  EXPECT_NEAR(scene.at(0.0).cast({{0.0, 0.0, 1.0}, -Vector3d::UnitZ()}, kFar)->distance, 1.0, 1e-9);
}

TEST(Scene, NormalsOfMovingThingsAreInTheWorld) {
  SceneDescription description;
  description.bodies.push_back(
      {{makeBox(Vector3d::Zero(), {1.0, 1.0, 1.0}, kGrey)}, [](double time) {
         return atPlace({5.0, 0.0, 0.0}, time);
       }});
  const Scene scene(description);
  const auto hit = scene.at(0.3).cast({Vector3d::Zero(), Vector3d::UnitX()}, kFar);
  ASSERT_TRUE(hit);
  EXPECT_LT((hit->normal - Vector3d(-std::cos(0.3), -std::sin(0.3), 0.0)).norm(), 1e-9);
}

}  // namespace
}  // namespace pcrb_tools::simulation
