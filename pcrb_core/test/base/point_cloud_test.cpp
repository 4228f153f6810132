#include "pcrb_core/point_cloud.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

DatasetCloud somewhereAtUtm() {
  DatasetCloud cloud;
  cloud.points = {{351234.123456, 8045123.987654, 42.5}, {351300.5, 8045100.25, 40.0}};
  return cloud;
}

TEST(PointCloud, LocalOriginLiesOnTheGridNearTheTarget) {
  const Eigen::Vector3d origin = chooseLocalOrigin(somewhereAtUtm());
  EXPECT_EQ(origin, Eigen::Vector3d(351300, 8045100, 0));
  EXPECT_THROW(chooseLocalOrigin(DatasetCloud()), InvalidProblem);
}

TEST(PointCloud, LosesLessThanATenthOfAMillimetreAtUtmCoordinates) {
  const DatasetCloud cloud = somewhereAtUtm();
  const PointCloud local = makeLocal(cloud, chooseLocalOrigin(cloud));
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3d back = local.points[i].cast<double>() + local.local_origin;
    EXPECT_LT((back - cloud.points[i]).norm(), 1e-4);
  }
}

TEST(PointCloud, RejectsPointsTooFarFromTheOrigin) {
  EXPECT_THROW(makeLocal(somewhereAtUtm(), Eigen::Vector3d::Zero()), InvalidProblem);
}

TEST(PointCloud, TransformedPointsAreTheNaiveOnesAtAnyStride) {
  PointCloud cloud;
  for (int i = 0; i < 1000; ++i) {
    cloud.points.emplace_back(0.37f * static_cast<float>(i), -0.11f * static_cast<float>(i), 5.0f);
  }
  const Transform T = makeTransform({1.5, -2.5, 0.25}, Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2));
  for (const std::size_t stride : {12u, 16u}) {
    std::vector<std::uint8_t> out(cloud.size() * stride + 1, 0xab);
    transformPoints(cloud, T, out.data(), stride);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      Eigen::Vector3f moved;
      std::memcpy(moved.data(), out.data() + i * stride, 12);
      const Eigen::Vector3d naive = T * cloud.points[i].cast<double>();
      ASSERT_LE((moved.cast<double>() - naive).norm(), 1e-6 * (1.0 + naive.norm()));
    }
    EXPECT_EQ(out.back(), 0xab);
  }
  transformPoints(PointCloud(), T, nullptr, 12);
}

TEST(PointCloud, HasTheSameBitsAtEveryStrideAndLength) {
  Random random(3);
  const Transform T = makeTransform({1.5, -2.5, 0.25}, Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2));
  PointCloud cloud;
  for (int size = 1; size <= 40; ++size) {  // with and without a rest beside blocks of eight
    cloud.points.push_back((random.direction() * random.uniform(0.0, 900.0)).cast<float>());
    std::vector<std::uint8_t> packed(cloud.size() * 12 + 1, 0xab), spaced(cloud.size() * 16);
    transformPoints(cloud, T, packed.data(), 12);
    transformPoints(cloud, T, spaced.data(), 16);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      ASSERT_EQ(std::memcmp(&packed[i * 12], &spaced[i * 16], 12), 0) << i << " of " << size;
    }
    ASSERT_EQ(packed.back(), 0xab);
  }
}

}  // namespace
}  // namespace pcrb
