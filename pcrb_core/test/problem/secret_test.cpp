#include "pcrb_core/problem/secret.hpp"

#include <gtest/gtest.h>

#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/presentation.hpp"

namespace pcrb {
namespace {

const char* const kHex = "000102030405060708090a0b0c0d0e0f";

TEST(Secret, IsDrawnAnewEveryTime) { EXPECT_NE(Secret::draw().toHex(), Secret::draw().toHex()); }

TEST(Secret, SurvivesItsText) {
  const Secret secret = Secret::draw();
  const Secret again = Secret::fromHex(secret.toHex());
  EXPECT_EQ(secret.toHex(), again.toHex());
  EXPECT_EQ(secret.bits("order", "a"), again.bits("order", "a"));
}

TEST(Secret, RejectsTextThatIsNot32HexadecimalDigits) {
  for (const char* text :
       {"", "00", "zz0102030405060708090a0b0c0d0e0f", "000102030405060708090a0b0c0d0e0f00",
        "00 102030405060708090a0b0c0d0e0f"}) {
    EXPECT_THROW(Secret::fromHex(text), InvalidParameter) << text;
  }
}

TEST(Secret, GivesDifferentIdsToDifferentProblemsAndRuns) {
  const Secret secret = Secret::fromHex(kHex);
  std::set<std::string> ids;
  for (int i = 0; i < 1000; ++i) ids.insert(secret.publicId("problem " + std::to_string(i)));
  EXPECT_EQ(ids.size(), 1000u);
  EXPECT_EQ(ids.begin()->size(), 32u);
  EXPECT_NE(secret.publicId("problem 0"), Secret::draw().publicId("problem 0"));
}

TEST(Secret, DerivesRotationsThatSpreadOverAllDirections) {
  const Secret secret = Secret::fromHex(kHex);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Quaterniond q = secret.rotation(std::to_string(i));
    EXPECT_NEAR(q.norm(), 1.0, 1e-12);
    mean += q * Eigen::Vector3d::UnitZ() / kCount;
  }
  EXPECT_LT(mean.norm(), 0.05);  // 5 standard deviations of the mean of 4000 unit vectors
}

TEST(Presentation, EquivalentRepliesLeaveTheSameResidual) {
  const Secret secret = Secret::fromHex(kHex);
  const Transform P = makeTransform({0.3, -0.2, 0.1}, Eigen::Quaterniond(0.95, 0.1, 0.2, 0.05));
  const Transform viewpoint = makeTransform({12, -7, 1.5}, Eigen::Quaterniond(0.4, 0.1, 0, 0.9));
  const Transform reply = makeTransform({-0.2, 0.25, 0}, Eigen::Quaterniond(0.97, -0.1, -0.15, 0));
  for (const bool has_viewpoint : {true, false}) {
    const Transform V = secretSensorPose(secret, "a", has_viewpoint, viewpoint, {10, -8, 1}, false);
    const Presentation localization = presentForLocalization(P, V);
    const Transform equivalent = reply * P * V;
    EXPECT_TRUE(localization.residual(equivalent)
                    .isApprox(presentForRegistration(P).residual(reply), 1e-12));
  }
}

TEST(Presentation, AnEchoOfTheGuessLeavesThePerturbation) {
  const Transform P = makeTransform({0.3, -0.2, 0.1}, Eigen::Quaterniond(0.95, 0.1, 0.2, 0.05));
  const Transform V = makeTransform({12, -7, 1.5}, Eigen::Quaterniond(0.4, 0.1, 0, 0.9));
  for (const Presentation& p : {presentForRegistration(P), presentForLocalization(P, V)}) {
    EXPECT_TRUE(p.residual(p.guess).isApprox(P, 1e-12));
    EXPECT_TRUE(p.residual(p.applied.inverse()).isApprox(Transform::Identity(), 1e-12));
  }
}

TEST(Presentation, KeepsTheSensorsZAxisAndPositionWhereTheViewpointIsKnown) {
  const Transform viewpoint = makeTransform({12, -7, 1.5}, Eigen::Quaterniond(0.4, 0.1, 0, 0.9));
  const Transform V = secretSensorPose(Secret::draw(), "a", true, viewpoint, {0, 0, 0}, false);
  EXPECT_TRUE(V.translation().isApprox(viewpoint.translation()));
  EXPECT_TRUE(V.linear().col(2).isApprox(viewpoint.linear().col(2), 1e-12));
  EXPECT_FALSE(V.linear().isApprox(viewpoint.linear(), 1e-6));
}

}  // namespace
}  // namespace pcrb
