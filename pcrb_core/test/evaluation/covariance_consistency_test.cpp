#include "pcrb_core/evaluation/covariance_consistency.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

PoseCovariance covarianceOfMatrix(const Matrix6& C) {
  PoseCovariance covariance{};
  Eigen::Map<Matrix6>(covariance.data()) = C;
  return covariance;
}

PoseCovariance diagonal(double variance) {
  return covarianceOfMatrix(variance * Matrix6::Identity());
}

/// A covariance with correlations between all axes, and a factor of it.
Matrix6 someFactor() {
  Random random(5);
  Matrix6 L = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) L(i, j) = random.uniform(-0.05, 0.05);
    L(i, i) = random.uniform(0.05, 0.1);
  }
  return L;
}

double normal(Random& random) {
  const double u = 1.0 - random.uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * M_PI * random.uniform());
}

/// Errors of a covariance, each judged against `factor` times that covariance.
std::vector<JudgedCovariance> drawn(std::size_t count, double factor) {
  const Matrix6 L = someFactor();
  const PoseCovariance stated = covarianceOfMatrix(factor * L * L.transpose());
  Random random(11);
  std::vector<JudgedCovariance> judged;
  for (std::size_t i = 0; i < count; ++i) {
    PoseErrorVector z;
    for (int axis = 0; axis < 6; ++axis) z[axis] = normal(random);
    judged.push_back(judgeCovariance(L * z, stated).value());
  }
  return judged;
}

std::vector<std::size_t> eachItsOwn(std::size_t count) {
  std::vector<std::size_t> units;
  for (std::size_t i = 0; i < count; ++i) units.push_back(i);
  return units;
}

TEST(ChiSquare, IsThatOfScipy) {
  const double at_three[] = {0.9167354833364496, 0.7768698398515702, 0.6083748237289109,
                             0.4421745996289252, 0.3000141641213724, 0.19115316946194183};
  const double at_95[] = {3.841458820694124, 5.991464547107979,  7.814727903251179,
                          9.487729036781154, 11.070497693516351, 12.591587243743977};
  for (int k = 1; k <= 6; ++k) {
    EXPECT_NEAR(chiSquareCdf(3.0, k), at_three[k - 1], 1e-14) << k;
    EXPECT_NEAR(chiSquareQuantile(0.95, k), at_95[k - 1], 1e-10) << k;
    EXPECT_EQ(chiSquareCdf(0.0, k), 0.0) << k;
    EXPECT_EQ(chiSquareCdf(std::numeric_limits<double>::infinity(), k), 1.0) << k;
  }
  EXPECT_THROW(chiSquareCdf(-1.0, 6), InvalidParameter);
  EXPECT_THROW(chiSquareCdf(1.0, 0), InvalidParameter);
  EXPECT_THROW(chiSquareQuantile(1.0, 6), InvalidParameter);
}

TEST(PoseErrorVector, IsTheDifferenceOfPositionsAndTheTurnInTheParentFrame) {
  const Transform truth = makeTransform(
      {1, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX())));
  const Transform estimate = makeTransform(
      {1.5, 2, 2}, Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX())));
  PoseErrorVector expected;
  expected << 0.5, 0, -1, 0, 0, 0.2;
  EXPECT_LT((poseErrorVector(estimate, truth) - expected).norm(), 1e-12);
}

TEST(JudgedCovariance, HasTheNeesOfTheFormula) {
  PoseErrorVector error;
  error << 0.1, 0, 0, 0, 0, 0.02;
  Matrix6 C = Matrix6::Identity();
  C(0, 0) = 0.01;
  C(5, 5) = 0.0004;
  C(0, 5) = C(5, 0) = 0.001;  // correlation 0.5 of two errors of one σ each: (1 + 1 − 1) / 0.75
  const auto judged = judgeCovariance(error, covarianceOfMatrix(C)).value();
  EXPECT_NEAR(judged.nees, 4.0 / 3.0, 1e-12);
  EXPECT_EQ(judged.degrees, 6);
  EXPECT_NEAR(judged.normalized[0].value(), 1.0, 1e-12);
  EXPECT_NEAR(judged.deviations[5], 0.02, 1e-15);
  EXPECT_NEAR(judged.probability, chiSquareCdf(4.0 / 3.0, 6), 1e-15);
}

TEST(JudgedCovariance, OfAPlanarNodeHasThreeDegreesOfFreedom) {
  PoseErrorVector error;
  error << 0.1, 0.2, 5.0, 1.0, 1.0, 0.1;
  Matrix6 C = Matrix6::Zero();
  C(0, 0) = C(1, 1) = C(5, 5) = 0.01;
  const auto judged = judgeCovariance(error, covarianceOfMatrix(C)).value();
  EXPECT_EQ(judged.degrees, 3);
  EXPECT_NEAR(judged.nees, 6.0, 1e-12);
  EXPECT_FALSE(judged.normalized[2].has_value());
  EXPECT_EQ(calibrateAxis({judged}, 2).count, 0u);
  EXPECT_NEAR(calibrateAxis({judged}, 1).rms_normalized, 2.0, 1e-12);
}

TEST(JudgedCovariance, IsTheSameAboutOtherAxes) {
  const Matrix6 L = someFactor();
  const PoseCovariance C = covarianceOfMatrix(L * L.transpose());
  PoseErrorVector error;
  error << 0.1, -0.2, 0.05, 0.01, 0.02, -0.03;
  Random random(3);
  const Eigen::Matrix3d R = random.rotation().toRotationMatrix();
  PoseErrorVector turned;
  turned << R * error.head<3>(), R * error.tail<3>();
  EXPECT_NEAR(judgeCovariance(turned, rotatedCovariance(C, R))->nees,
              judgeCovariance(error, C)->nees, 1e-9);
}

TEST(JudgedCovariance, IsNoneWhereTheMatrixIsNoCovariance) {
  const PoseErrorVector error = PoseErrorVector::Constant(0.1);
  EXPECT_FALSE(judgeCovariance(error, PoseCovariance{}));
  EXPECT_FALSE(judgeCovariance(error, diagonal(-1.0)));
  EXPECT_FALSE(judgeCovariance(error, diagonal(std::nan(""))));
  Matrix6 C = Matrix6::Identity();
  C(0, 1) = 0.5;
  EXPECT_FALSE(judgeCovariance(error, covarianceOfMatrix(C))) << "not symmetric";
  C(1, 0) = 0.5;
  EXPECT_TRUE(judgeCovariance(error, covarianceOfMatrix(C)));
  C(0, 1) = C(1, 0) = 1.0;
  EXPECT_FALSE(judgeCovariance(error, covarianceOfMatrix(C))) << "singular";
  C(0, 1) = C(1, 0) = 2.0;
  EXPECT_FALSE(judgeCovariance(error, covarianceOfMatrix(C))) << "indefinite";
  C = Matrix6::Identity();
  C(2, 2) = 0.0;
  C(2, 3) = C(3, 2) = 0.1;
  EXPECT_FALSE(judgeCovariance(error, covarianceOfMatrix(C))) << "covariance without variance";
}

TEST(Calibration, OfRightCovariancesIsRight) {
  const auto judged = drawn(4000, 1.0);
  const Calibration calibration = calibrate(judged, eachItsOwn(judged.size()));
  EXPECT_NEAR(calibration.mean_ratio, 1.0, 0.05);
  EXPECT_NEAR(calibration.median_ratio, 1.0, 0.05);
  EXPECT_NEAR(calibration.inside_50.value, 0.5, 0.03);
  EXPECT_NEAR(calibration.inside_95.value, 0.95, 0.015);
  EXPECT_EQ(calibration.verdict, "as large as the errors");
  const auto curve = calibrationCurve(judged, {0.1, 0.5, 0.9});
  EXPECT_NEAR(curve[0], 0.1, 0.02);
  EXPECT_NEAR(curve[2], 0.9, 0.02);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const AxisCalibration one = calibrateAxis(judged, axis);
    EXPECT_NEAR(one.rms_normalized, 1.0, 0.05) << axis;
    EXPECT_NEAR(one.inside_50, 0.5, 0.03) << axis;
    EXPECT_NEAR(one.inside_95, 0.95, 0.015) << axis;
  }
}

TEST(Calibration, TellsOverconfidentFromUnderconfident) {
  const auto narrow = drawn(500, 0.25);
  EXPECT_NEAR(calibrate(narrow, eachItsOwn(500)).mean_ratio, 4.0, 0.4);
  EXPECT_EQ(calibrate(narrow, eachItsOwn(500)).verdict, "overconfident");
  const auto wide = drawn(500, 4.0);
  EXPECT_EQ(calibrate(wide, eachItsOwn(500)).verdict, "underconfident");
  auto failing = drawn(500, 1.0);
  for (std::size_t i = 0; i < failing.size(); i += 16) failing[i].probability = 1.0;
  EXPECT_EQ(calibrate(failing, eachItsOwn(500)).verdict, "overconfident where it fails");
}

TEST(Calibration, CountsPairsOfCloudsNotProblems) {
  const auto narrow = drawn(500, 0.25);
  std::vector<std::size_t> five_pairs;
  for (std::size_t i = 0; i < narrow.size(); ++i) five_pairs.push_back(i % 5);
  const Calibration calibration = calibrate(narrow, five_pairs);
  EXPECT_EQ(calibration.verdict, "too few pairs to tell");
  EXPECT_EQ(calibration.inside_50.low, proportion(calibration.inside_50.value, 5).low);
  EXPECT_THROW(calibrate(narrow, {0}), InvalidParameter);
  EXPECT_THROW(calibrate({}, {}), InvalidParameter);
}

TEST(Proportion, HasWilsonsInterval) {
  const Proportion half = proportion(0.5, 10);  // by hand: 0.5 ± 0.2634
  EXPECT_NEAR(half.low, 0.23659, 1e-5);
  EXPECT_NEAR(half.high, 0.76341, 1e-5);
  EXPECT_EQ(proportion(0.0, 10).low, 0.0);
  EXPECT_NEAR(proportion(0.0, 10).high, 0.27753, 1e-5);
  EXPECT_THROW(proportion(1.5, 10), InvalidParameter);
  EXPECT_THROW(proportion(0.5, 0), InvalidParameter);
}

}  // namespace
}  // namespace pcrb
