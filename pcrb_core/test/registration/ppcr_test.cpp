#include <gtest/gtest.h>

#include <limits>

#include "pcrb_core/registration/parameters.hpp"
#include "pcrb_core/registration/registration.hpp"
#include "registration/ppcr_steps.hpp"
#include "support/scenes.hpp"
#include "support/textbook_ppcr.hpp"

namespace pcrb {
namespace {

using pcrb_test::hall;
using pcrb_test::shared;
using pcrb_test::transformed;

constexpr double kNoRadius = std::numeric_limits<double>::infinity();

Points moved(const Points& points, const Transform& T) {
  Points result;
  for (const auto& point : points) result.push_back((T * point.cast<double>()).cast<float>());
  return result;
}

TEST(PpcrAssociation, GivesThePairsOfASearchAnewAfterAnyMovement) {
  const KdTree target(voxelGrid(hall(1).points, 0.3));
  const Points source = subsample(voxelGrid(hall(2).points, 0.3), 0.2, 1);
  PpcrAssociation warm(target, source.size(), 10, 0.7, kNoRadius, 2);
  Random random(1);
  Transform T = pcrb_test::randomMotion(random, 0.2, 1.0);
  for (const double step : {0.5, 0.1, 0.02, 0.02, 0.005, 0.001, 0.0, 0.3, 0.01}) {
    T = pcrb_test::randomMotion(random, step / 5.0, step) * T;
    const Points position = moved(source, T);
    warm.update(position);
    PpcrAssociation fresh(target, source.size(), 10, 0.7, kNoRadius, 1);
    fresh.update(position);
    EXPECT_EQ(warm.pairs().candidates, fresh.pairs().candidates) << step;
    EXPECT_EQ(warm.pairs().kept, fresh.pairs().kept) << step;
  }
}

TEST(PpcrAssociation, SaysWhetherAPairChanged) {
  const KdTree target(voxelGrid(hall(1).points, 0.3));
  const Points source = subsample(voxelGrid(hall(2).points, 0.3), 0.2, 1);
  PpcrAssociation association(target, source.size(), 10, 0.7, kNoRadius, 1);
  EXPECT_TRUE(association.update(source));
  EXPECT_FALSE(association.update(source));
  EXPECT_TRUE(association.update(moved(source, Transform(Eigen::Translation3d(0.2, 0, 0)))));
}

TEST(PpcrAssociation, CutsAtTheQuantileOfAllDistancesAndAtTheRadius) {
  Points line;
  for (int i = 0; i < 100; ++i) line.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
  const KdTree target(line);
  const Points source{{0, 0, 0}, {0, 0, 0}};
  const auto keptWith = [&](double quantile, double radius) {
    PpcrAssociation association(target, source.size(), 10, quantile, radius, 1);
    association.update(source);
    const auto& kept = association.pairs().kept;
    return std::count(kept.begin(), kept.end(), 1.0F);
  };
  // 20 squared distances: 0 0 1 1 4 4 … 81 81; the one of rank 14 is 49.
  EXPECT_EQ(keptWith(0.7, kNoRadius), 16);
  EXPECT_EQ(keptWith(1.0, kNoRadius), 20);
  EXPECT_EQ(keptWith(1.0, 3.5), 8);
  EXPECT_EQ(keptWith(0.5, 3.5), 6);
}

TEST(Ppcr, EndsWithinOnePercentOfTheTextbook) {
  constexpr double kGridLeaf = 0.6;
  const Parameters parameters{{"voxel_leaf", "0.6"}};
  for (const std::uint64_t seed : {1U, 2U}) {
    Random random(seed);
    const Transform P = pcrb_test::randomMotion(random, 0.15, 0.5);
    const PointCloud target = hall(1);
    const PointCloud source = transformed(hall(2), P);
    const auto method = makeRegistration("ppcr", parameters);
    method->setTarget(shared(target));
    const auto found = method->align(source, Transform::Identity()).T_target_source;

    // The method works relative to the target's centroid, rounded to metres: so do its cells.
    const Transform shift(Eigen::Translation3d(-centroid(target).array().round().matrix()));
    const Points y = voxelGrid(transformed(target, shift).points, kGridLeaf);
    const Points x = subsample(voxelGrid(transformed(source, shift).points, kGridLeaf), 0.3, 1);
    pcrb_test::TextbookPpcr textbook(y, x, 10);
    const Transform expected = shift.inverse() * textbook.align(Transform::Identity()) * shift;

    const Transform difference = expected.inverse() * found;
    EXPECT_LT(rotationAngle(difference.linear()), 0.01 * rotationAngle(P.linear())) << seed;
    EXPECT_LT((difference * P.translation() - P.translation()).norm(), 0.01 * 0.5) << seed;
  }
}

TEST(Ppcr, FailsWhereNoPointIsWithinTheSearchRadius) {
  const auto method = makeRegistration("ppcr", {{"search_radius", "0.5"}});
  method->setTarget(shared(hall(1)));
  const auto away = transformed(hall(1), Transform(Eigen::Translation3d(0, 0, 50)));
  EXPECT_THROW(method->align(away, Transform::Identity()), RegistrationFailed);
}

TEST(Ppcr, WorksWithoutVoxelGridAndSamplingAsTheGroundTruthEvaluationNeeds) {
  const auto method = makeRegistration("ppcr", {{"voxel_leaf", "0"},
                                                {"sampling_fraction", "1"},
                                                {"search_radius", "0.2"},
                                                {"cut_quantile", "1"},
                                                {"robust", "false"}});
  method->setTarget(shared(hall(1)));
  const auto result = method->align(hall(2), Transform::Identity());
  EXPECT_LT(result.T_target_source.translation().norm(), 0.01);
  EXPECT_LT(rotationAngle(result.T_target_source.linear()), 0.002);
}

TEST(Ppcr, HasTheTextsParametersInAFileOfTheirOwn) {
  const std::string path =
      std::string(PCRB_SOURCE_DIR) + "/../launch/config/methods/ppcr_text.yaml";
  Parameters expected = registrationDefaults("ppcr");
  expected["neighbors"] = "20";
  EXPECT_EQ(MethodParameters(path).of("eth", 0.2), expected);
}

}  // namespace
}  // namespace pcrb
