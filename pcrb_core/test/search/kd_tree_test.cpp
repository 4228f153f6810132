#include "pcrb_core/search/kd_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

std::vector<Neighbor> bruteForce(const std::vector<Eigen::Vector3f>& points,
                                 const Eigen::Vector3f& query) {
  std::vector<Neighbor> all;
  for (const auto& point : points) {
    all.push_back({static_cast<std::uint32_t>(all.size()), (point - query).squaredNorm()});
  }
  std::sort(all.begin(), all.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.squared_distance < b.squared_distance;
  });
  return all;
}

class KdTreeSearch : public ::testing::Test {
 protected:
  std::vector<Eigen::Vector3f> randomPoints(std::size_t count) {
    std::vector<Eigen::Vector3f> points;
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector3f point;
      for (int axis = 0; axis < 3; ++axis) point[axis] = static_cast<float>(random_.uniform());
      points.push_back(point);
    }
    return points;
  }

  Random random_{3};
};

TEST_F(KdTreeSearch, FindsTheNearestPointsOfABruteForceSearch) {
  const auto points = randomPoints(2000);
  const KdTree tree(points);
  std::vector<Neighbor> found;
  for (const auto& query : randomPoints(200)) {
    const auto expected = bruteForce(points, query);
    EXPECT_EQ(tree.nearest(query).index, expected.front().index);
    tree.nearest(query, 20, found);
    ASSERT_EQ(found.size(), 20U);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].index, expected[i].index);
  }
}

TEST_F(KdTreeSearch, FindsAllPointsWithinARadius) {
  const auto points = randomPoints(2000);
  const KdTree tree(points);
  std::vector<Neighbor> found;
  for (const auto& query : randomPoints(50)) {
    tree.within(query, 0.2F, found);
    const auto all = bruteForce(points, query);
    const auto expected = std::count_if(all.begin(), all.end(), [](const Neighbor& neighbor) {
      return neighbor.squared_distance < 0.2F * 0.2F;
    });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(found.size()), expected);
  }
}

TEST_F(KdTreeSearch, GivesAllPointsWhereThereAreFewerThanAskedFor) {
  const KdTree tree(randomPoints(7));
  std::vector<Neighbor> found;
  tree.nearest(Eigen::Vector3f::Zero(), 20, found);
  EXPECT_EQ(found.size(), 7U);
}

TEST_F(KdTreeSearch, RejectsAnEmptySetOfPoints) { EXPECT_THROW(KdTree({}), InvalidProblem); }

}  // namespace
}  // namespace pcrb
