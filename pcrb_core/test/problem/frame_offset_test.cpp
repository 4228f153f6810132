#include "problem/frame_offset.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/perturbation.hpp"

namespace pcrb {
namespace {

const Eigen::Vector3d kUtm(351000.0, 4022500.0, 20.0);

std::vector<PerturbedCentroid> rowsWithOffset(const Eigen::Vector3d& offset, std::size_t n) {
  std::vector<PerturbedCentroid> rows;
  Random random(3);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d c = kUtm + 200.0 * random.direction();
    rows.push_back({samplePerturbation(c + offset, {{0, 1}, {0, 30}}, random), c});
  }
  return rows;
}

TEST(FrameOffset, IsFoundWithinItsStandardError) {
  for (const Eigen::Vector3d& offset :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(10, -20, 0.5), kUtm}) {
    const FrameOffset estimate = estimateFrameOffset(rowsWithOffset(offset, 3000));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LT(std::abs(estimate.offset[axis] - offset[axis]),
                4.0 * estimate.standard_error[axis]);
      EXPECT_LT(estimate.standard_error[axis], 0.1);
      EXPECT_GT(estimate.standard_error[axis], 0.005);
    }
    EXPECT_NEAR(estimate.residual, std::sqrt(1.0 / 3.0), 0.03);  // of lengths uniform on [0, 1] m
  }
}

TEST(FrameOffset, StandardErrorFallsWithTheRootOfTheRows) {
  const double few = estimateFrameOffset(rowsWithOffset(kUtm, 100)).standard_error.norm();
  const double many = estimateFrameOffset(rowsWithOffset(kUtm, 10000)).standard_error.norm();
  EXPECT_NEAR(few / many, 10.0, 2.5);
}

TEST(FrameOffset, NeedsRotationsAboutMoreThanOneAxis) {
  EXPECT_THROW(estimateFrameOffset({}), InvalidProblem);
  EXPECT_THROW(estimateFrameOffset(rowsWithOffset(kUtm, 1)), InvalidProblem);
  std::vector<PerturbedCentroid> rows(10);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].P.linear() = Eigen::AngleAxisd(0.1 * static_cast<double>(i), Eigen::Vector3d::UnitZ())
                             .toRotationMatrix();
  }
  EXPECT_THROW(estimateFrameOffset(rows), InvalidProblem);
}

}  // namespace
}  // namespace pcrb
