#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"
#include "playback/scene_parts.hpp"

namespace pcrb {
namespace {

DatasetCloud randomCloud(std::uint64_t seed, std::size_t count, double extent) {
  Random random(seed);
  DatasetCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    cloud.points.emplace_back(random.uniform(0, extent), random.uniform(0, extent), 0.0);
  }
  return cloud;
}

TEST(BoundedMap, IsAVoxelMapBelowItsLimit) {
  BoundedMap map(0.1, 100000);
  VoxelMap expected(0.1);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    map.add(randomCloud(seed, 500, 10.0));
    expected.add(randomCloud(seed, 500, 10.0));
  }
  EXPECT_EQ(map.cloud().points, expected.cloud().points);
  EXPECT_EQ(map.leaf(), 0.1);
}

TEST(BoundedMap, DoublesItsVoxelsUntilItKeepsTheLimit) {
  BoundedMap map(0.1, 200);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    map.add(randomCloud(seed, 2000, 10.0));
    EXPECT_LE(map.size(), 200U);
  }
  EXPECT_EQ(map.leaf(), 0.8);  // 10 m / 0.8 m, squared, is the first that fits
  EXPECT_GT(map.size(), 100U);
}

TEST(BoundedMap, RefusesALimitOfNothing) { EXPECT_THROW(BoundedMap(0.1, 0), InvalidParameter); }

}  // namespace
}  // namespace pcrb
