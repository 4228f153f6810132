#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simulation/depth_camera.hpp"
#include "simulation/noise.hpp"
#include "simulation/props.hpp"
#include "simulation/scanner.hpp"
#include "simulation/surfaces.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;

const Ray kAhead{Vector3d::Zero(), Vector3d::UnitX()};
const LidarModel kPlainLidar{0.1, 30.0, 0.01, 0.001, 0.0015, 0.0, 0.0, 0.02};

Scene wallAt(double distance, const Surface& surface) {
  SceneDescription description;
  description.shapes.push_back(makeBox({distance + 0.5, 0.0, 0.0}, {1.0, 100.0, 100.0}, surface));
  return Scene(description);
}

pcrb::Transform standing(double) { return pcrb::Transform::Identity(); }

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};

Spread spreadOf(const std::vector<double>& values) {
  Spread spread;
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  for (const double value : values) {
    spread.deviation += std::pow(value - spread.mean, 2) / static_cast<double>(values.size());
  }
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

TEST(DrawNormal, HasMeanZeroAndDeviationOne) {
  pcrb::Random random(1);
  std::vector<double> values(20000);
  for (double& value : values) value = drawNormal(random);
  const Spread spread = spreadOf(values);
  EXPECT_NEAR(spread.mean, 0.0, 0.03);
  EXPECT_NEAR(spread.deviation, 1.0, 0.03);
}

TEST(MakeStream, DependsOnSeedNameAndIndex) {
  const auto first = [](pcrb::Random random) { return random.bits(); };
  EXPECT_EQ(first(makeStream(1, "a", 2)), first(makeStream(1, "a", 2)));
  EXPECT_NE(first(makeStream(1, "a", 2)), first(makeStream(2, "a", 2)));
  EXPECT_NE(first(makeStream(1, "a", 2)), first(makeStream(1, "b", 2)));
  EXPECT_NE(first(makeStream(1, "a", 2)), first(makeStream(1, "a", 3)));
}

TEST(Lidar, RangesSpreadAboutTheWallByTheNoise) {
  const Scene wall = wallAt(5.0, kPlaster);
  pcrb::Random random(1);
  std::vector<double> ranges;
  for (int i = 0; i < 5000; ++i) {
    ranges.push_back(measure(wall.at(0.0), kAhead, kPlainLidar, random).value().range);
  }
  const Spread spread = spreadOf(ranges);
  EXPECT_NEAR(spread.mean, 5.0, 0.001);
  EXPECT_NEAR(spread.deviation, 0.01, 0.001);
}

TEST(Lidar, RangesAreMultiplesOfTheResolution) {
  const Scene wall = wallAt(5.0, kPlaster);
  pcrb::Random random(1);
  const double range = measure(wall.at(0.0), kAhead, kPlainLidar, random).value().range;
  EXPECT_NEAR(std::remainder(range, 0.001), 0.0, 1e-9);
}

TEST(Lidar, SeesNothingBeyondItsRangeOnGlassOrOnWhatIsDarkAndFar) {
  pcrb::Random random(1);
  EXPECT_FALSE(measure(wallAt(31.0, kPlaster).at(0.0), kAhead, kPlainLidar, random));
  EXPECT_FALSE(measure(wallAt(2.0, kGlass).at(0.0), kAhead, kPlainLidar, random));
  LidarModel weak = kPlainLidar;
  weak.weakest_echo = 0.3;
  EXPECT_TRUE(measure(wallAt(5.0, kRubber).at(0.0), kAhead, weak, random));
  EXPECT_FALSE(measure(wallAt(25.0, kRubber).at(0.0), kAhead, weak, random));
}

TEST(Lidar, LosesTheShareOfEchoesThatItsModelSays) {
  const Scene wall = wallAt(5.0, kPlaster);
  LidarModel lossy = kPlainLidar;
  lossy.lost_share = 0.1;
  pcrb::Random random(1);
  int lost = 0;
  for (int i = 0; i < 5000; ++i) lost += measure(wall.at(0.0), kAhead, lossy, random) ? 0 : 1;
  EXPECT_NEAR(lost / 5000.0, 0.1, 0.015);
}

TEST(Lidar, MixedPixelsLieBetweenTheEdgeAndWhatIsBehind) {
  SceneDescription description;
  description.shapes.push_back(makeBox({6.0, 0.0, 0.0}, {1.0, 100.0, 100.0}, kPlaster));
  description.shapes.push_back(makeBox({5.0, -50.0, 0.0}, {0.02, 100.0, 100.0}, kPlaster));
  const Scene step(description);
  LidarModel mixing = kPlainLidar;
  mixing.range_noise = 0.0;
  mixing.mixed_share = 1.0;
  pcrb::Random random(1);
  int between = 0;
  for (int i = 0; i < 1000; ++i) {
    const Ray at_edge{{0.0, -0.001, 0.0}, Vector3d::UnitX()};
    const double range = measure(step.at(0.0), at_edge, mixing, random).value().range;
    EXPECT_GE(range, 4.989);
    EXPECT_LE(range, 5.501);
    if (range > 5.0 && range < 5.48) ++between;
  }
  EXPECT_GT(between, 100);
}

TEST(Scanner, TiltingHeadStartsLookingUpAndNodsDown) {
  const Scanner scanner = makeTiltingHokuyo(3, 5);
  pcrb::Random random(1);
  SceneDescription description;
  for (const double z : {-2.0, 2.0}) {
    description.shapes.push_back(makeBox({0.0, 0.0, z * 1.5}, {100.0, 100.0, 2.0}, kPlaster));
  }
  const auto points = takeScan(Scene(description), scanner, standing, 0.0, random);
  ASSERT_EQ(points.size(), 15U);
  EXPECT_NEAR(points[2].position.z(), 2.0, 0.1) << "first line, middle beam";
  EXPECT_GT(points[2].position.x(), 0.0);
  EXPECT_NEAR(points[12].position.z(), -2.0, 0.1) << "last line, middle beam";
  EXPECT_LT(points[0].position.y(), points[4].position.y()) << "the beams run to the left";
}

TEST(Scanner, VelodyneTurnsClockwiseOverSixteenLasers) {
  const Scanner vlp = makeVlp16(4);
  pcrb::Random random(1);
  SceneDescription description;
  for (const Vector3d& wall : {Vector3d(11.0, 0.0, 0.0), Vector3d(-11.0, 0.0, 0.0),
                               Vector3d(0.0, 11.0, 0.0), Vector3d(0.0, -11.0, 0.0)}) {
    description.shapes.push_back(makeBox(
        wall, {2.0 + 20.0 * (wall.x() == 0.0), 2.0 + 20.0 * (wall.y() == 0.0), 60.0}, kPlaster));
  }
  const auto points = takeScan(Scene(description), vlp, standing, 0.0, random);
  ASSERT_EQ(points.size(), 64U);
  EXPECT_NEAR(points[0].position.z() / std::hypot(points[0].position.x(), points[0].position.y()),
              std::tan(-15.0 * M_PI / 180.0), 1e-9);
  EXPECT_LT(points[3].position.x(), -9.0) << "180°";
  EXPECT_GT(points[16 + 3].position.y(), 9.0) << "90°";
  EXPECT_GT(points[32 + 3].position.x(), 9.0) << "0°";
  EXPECT_LT(points[48 + 3].position.y(), -9.0) << "−90°";
}

TEST(Scanner, MotionDuringAScanIsInItsPoints) {
  const Scene wall = wallAt(20.0, kPlaster);
  Scanner scanner = makeTiltingSick(2, 3);
  scanner.first_head = scanner.last_head = 0.0;
  scanner.first_beam = scanner.last_beam = 0.0;
  scanner.lidar = kPlainLidar;
  scanner.duration = 4.0;
  pcrb::Random random(1);
  const auto drive = [](double time) { return atPlace({time, 0.0, 0.0}, 0.0); };
  const auto points = takeScan(wall, scanner, drive, 10.0, random);
  EXPECT_NEAR(points[0].position.x(), 9.0, 0.06);
  EXPECT_NEAR(points[3].position.x(), 7.0, 0.06);
  EXPECT_DOUBLE_EQ(points[3].time, 13.0);
}

/// Camera at the origin that looks along the world's x.
pcrb::Transform lookingAhead() {
  pcrb::Transform pose = pcrb::Transform::Identity();
  pose.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return pose;
}

std::vector<double> depthsOfWall(double distance) {
  pcrb::Random random(1);
  const RgbdFrame frame =
      takeFrame(wallAt(distance, kPlaster), makeKinect(8), lookingAhead(), 0.0, random);
  std::vector<double> depths;
  for (const float depth : frame.depth) {
    if (std::isfinite(depth)) depths.push_back(static_cast<double>(depth));
  }
  return depths;
}

TEST(DepthCamera, DepthIsAlongItsAxisOverTheWholeImage) {
  const std::vector<double> depths = depthsOfWall(1.0);
  EXPECT_GT(depths.size(), 80U * 60U * 98 / 100);
  for (const double depth : depths) EXPECT_NEAR(depth, 1.0, 0.012);
}

TEST(DepthCamera, NoiseGrowsWithTheSquareOfTheDistance) {
  const double near = spreadOf(depthsOfWall(1.1)).deviation;
  const double far = spreadOf(depthsOfWall(4.4)).deviation;
  EXPECT_NEAR(near, 1.43e-3 * 1.21, 0.4e-3);
  EXPECT_NEAR(far / near, 16.0, 4.0);
}

TEST(DepthCamera, HasNoDepthTooNearTooFarOrOnAScreen) {
  EXPECT_TRUE(depthsOfWall(0.4).empty());
  EXPECT_TRUE(depthsOfWall(5.5).empty());
  pcrb::Random random(1);
  const RgbdFrame frame =
      takeFrame(wallAt(1.0, kGlass), makeKinect(8), lookingAhead(), 0.0, random);
  for (const float depth : frame.depth) EXPECT_TRUE(std::isnan(depth));
}

TEST(DepthCamera, ThingsCastAShadowBesideThemAwayFromTheProjector) {
  SceneDescription description;
  description.shapes.push_back(makeBox({3.5, 0.0, 0.0}, {1.0, 100.0, 100.0}, kPlaster));
  description.shapes.push_back(makeBox({1.0, 0.0, 0.0}, {0.02, 0.2, 0.2}, kPlaster));
  pcrb::Random random(1);
  const DepthCamera camera = makeKinect(4);
  const RgbdFrame frame = takeFrame(Scene(description), camera, lookingAhead(), 0.0, random);
  const auto row = frame.depth.begin() + static_cast<std::ptrdiff_t>(60 * camera.width);
  int left = 0;
  int right = 0;
  for (int u = 0; u < 80; ++u) left += std::isnan(row[u]) ? 1 : 0;
  for (int u = 80; u < 160; ++u) right += std::isnan(row[u]) ? 1 : 0;
  EXPECT_NEAR(left, 131.25 * 0.075 * (1.0 - 1.0 / 3.0), 3.0);
  EXPECT_LE(right, 2);
}

TEST(DepthCamera, ColorIsThatOfTheSurface) {
  pcrb::Random random(1);
  const RgbdFrame frame =
      takeFrame(wallAt(2.0, kRedPaint), makeKinect(8), lookingAhead(), 0.0, random);
  ASSERT_EQ(frame.color.size(), 3U * 80U * 60U);
  EXPECT_GT(frame.color[0], 3 * frame.color[1]);
}

}  // namespace
}  // namespace pcrb_tools::simulation
