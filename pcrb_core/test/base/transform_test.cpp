#include "pcrb_core/transform.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

Transform someTransform() {
  return makeTransform({1.0, -2.0, 0.5}, Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2).normalized());
}

TEST(Transform, LocalFrameConjugatesWithTheOrigin) {
  const Transform T = someTransform();
  const Eigen::Vector3d origin(100.0, -300.0, 200.0);
  const Eigen::Vector3d p_local(3.0, 4.0, -5.0);
  const Eigen::Vector3d expected = T * (p_local + origin) - origin;
  EXPECT_LT((inLocalFrame(T, origin) * p_local - expected).norm(), 1e-12);
}

TEST(Transform, LocalFrameLosesNothingWhereLargeTermsCancel) {
  // Exact in binary: the true motion of the origin is (0.25, 2^-30, 0).
  Transform T = Transform::Identity();
  T.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Eigen::Vector3d origin(0x1p23 + 0x1p-29, 0x1p33, 1e7);
  T.translation() = origin - T.linear() * origin;
  T.translation() += Eigen::Vector3d(0.25, 0, 0);
  const Eigen::Matrix<long double, 3, 1> o = origin.cast<long double>();
  const Eigen::Matrix<long double, 3, 1> expected =
      T.linear().cast<long double>() * o + T.translation().cast<long double>() - o;
  EXPECT_EQ(inLocalFrame(T, origin).translation(), expected.cast<double>());
  Transform turned = someTransform();
  turned.translation() -= (turned.linear() - Eigen::Matrix3d::Identity()) * origin;
  const Eigen::Matrix<long double, 3, 1> motion =
      turned.linear().cast<long double>() * o + turned.translation().cast<long double>() - o;
  EXPECT_LT((inLocalFrame(turned, origin).translation() - motion.cast<double>()).norm(), 1e-8);
}

TEST(Transform, RejectsMirrorsShearsAndNonFiniteEntries) {
  Eigen::Matrix<double, 3, 4> rows = someTransform().matrix().topRows<3>();
  EXPECT_NO_THROW(requireRigid(rows));
  Eigen::Matrix<double, 3, 4> mirrored = rows;
  mirrored.col(0) = -mirrored.col(0);
  EXPECT_THROW(requireRigid(mirrored), InvalidProblem);
  Eigen::Matrix<double, 3, 4> sheared = rows;
  sheared(0, 0) += 1e-5;
  EXPECT_THROW(requireRigid(sheared), InvalidProblem);
  Eigen::Matrix<double, 3, 4> infinite = rows;
  infinite(2, 3) = 1.0 / 0.0;
  EXPECT_THROW(requireRigid(infinite), InvalidProblem);
}

TEST(Transform, RotationAngleIsAccurateNearZeroAndPi) {
  for (const double angle : {0.0, 1e-9, 0.5, 3.0, M_PI - 1e-9, M_PI}) {
    const Eigen::AngleAxisd R(angle, Eigen::Vector3d(1, 2, 3).normalized());
    EXPECT_NEAR(rotationAngle(R.toRotationMatrix()), angle, 1e-12) << angle;
  }
}

}  // namespace
}  // namespace pcrb
