#include "pcrb_core/run/cloud_cache.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

std::shared_ptr<LoadedCloud> cloudOf(std::size_t points) {
  auto loaded = std::make_shared<LoadedCloud>();
  loaded->cloud.points.resize(points, Eigen::Vector3f::Zero());
  return loaded;
}

CloudCache::Key key(const std::string& path) { return {path, {0.0, 0.0, 0.0}}; }

TEST(CloudCache, DropsTheLeastRecentlyUsedBeyondItsLimit) {
  CloudCache cache(100'000);  // two clouds of 1000 points and no third
  cache.insert(key("a"), cloudOf(1000));
  cache.insert(key("b"), cloudOf(1000));
  EXPECT_NE(cache.find(key("a")), nullptr);
  cache.insert(key("c"), cloudOf(1000));
  EXPECT_EQ(cache.find(key("b")), nullptr);
  EXPECT_NE(cache.find(key("a")), nullptr);
  EXPECT_NE(cache.find(key("c")), nullptr);
}

TEST(CloudCache, KeepsTheLastCloudHoweverLarge) {
  CloudCache cache(1);
  cache.insert(key("a"), cloudOf(1000));
  EXPECT_NE(cache.find(key("a")), nullptr);
  cache.insert(key("b"), cloudOf(1000));
  EXPECT_EQ(cache.find(key("a")), nullptr);
}

TEST(CloudCache, TellsCloudsOfDifferentOriginsApart) {
  CloudCache cache(1 << 20);
  cache.insert(key("a"), cloudOf(1));
  EXPECT_EQ(cache.find({"a", {100.0, 0.0, 0.0}}), nullptr);
}

TEST(CloudCache, ReplacesWhatWasThereUnderAKey) {
  CloudCache cache(100'000);  // two clouds of 1000 points and no third
  cache.insert(key("a"), cloudOf(1000));
  const auto newer = cloudOf(1000);
  cache.insert(key("a"), newer);
  cache.insert(key("b"), cloudOf(1000));
  EXPECT_EQ(cache.find(key("a")), newer);
  EXPECT_NE(cache.find(key("b")), nullptr);
}

}  // namespace
}  // namespace pcrb
