#include "pcrb_core/problem/perturbation.hpp"

#include <gtest/gtest.h>

#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/point_cloud.hpp"

namespace pcrb {
namespace {

const Eigen::Vector3d kUtm(702000.0, 8045000.0, 30.0);

Eigen::Matrix3d someRotation() {
  return Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
}

TEST(Perturbation, MovesItsCentreByTheTranslationAlone) {
  const Eigen::Vector3d t(0.3, -0.2, 0.6);
  for (const Eigen::Vector3d& center : {Eigen::Vector3d(1, 2, 3), kUtm}) {
    const Transform P = makePerturbation(center, t, someRotation());
    EXPECT_LT((P * center - center - t).norm(), 1e-8);
    const Eigen::Vector3d beside = center + Eigen::Vector3d(1, 0, 0);
    EXPECT_LT((P * beside - center - t - someRotation().col(0)).norm(), 1e-8);
  }
}

TEST(FrameCheck, AcceptsMotionUpToTheBoundAndItsSlack) {
  const PerturbationBounds bounds{{0, 1}, {0, 30}};
  EXPECT_DOUBLE_EQ(maxCentroidMotion(bounds), 1.3);
  const auto moving = [](double t) { return makePerturbation(kUtm, {0, 0, t}, someRotation()); };
  EXPECT_NO_THROW(checkFrame(moving(1.299), kUtm, bounds));
  EXPECT_THROW(checkFrame(moving(1.301), kUtm, bounds), InvalidProblem);
}

TEST(FrameCheck, ExplainsCloudsInAnotherFrame) {
  const Transform P = makePerturbation(2.0 * kUtm, {0, 0, 0.5}, someRotation());
  try {
    checkFrame(P, kUtm, {{0, 1}, {0, 30}});
    FAIL() << "clouds at half the coordinates were accepted";
  } catch (const InvalidProblem& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("expected at most 1.3 m"), std::string::npos) << message;
    EXPECT_NE(message.find("another frame"), std::string::npos) << message;
  }
}

TEST(DatasetCloud, CentroidKeepsItsDigitsAtUtmCoordinates) {
  DatasetCloud cloud;
  for (int i = 0; i < 100000; ++i) {
    cloud.points.push_back(kUtm + Eigen::Vector3d(0.125 * (i % 5), 0.25 * (i % 2), 0.0));
  }
  EXPECT_LT((centroid(cloud) - kUtm - Eigen::Vector3d(0.25, 0.125, 0.0)).norm(), 2e-9);
  EXPECT_THROW(centroid(DatasetCloud{}), InvalidProblem);
}

}  // namespace
}  // namespace pcrb
