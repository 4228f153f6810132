#include "pcrb_core/problem/perturbation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb {
namespace {

const Eigen::Vector3d kFarCenter(702000.0, 8045000.0, 30.0);

Eigen::Matrix3d someRotation() {
  return Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
}

TEST(Perturbation, MovesItsCentreByTheTranslationAlone) {
  const Eigen::Vector3d t(0.3, -0.2, 0.6);
  for (const Eigen::Vector3d& center : {Eigen::Vector3d(1, 2, 3), kFarCenter}) {
    const Transform P = makePerturbation(center, t, someRotation());
    EXPECT_LT((P * center - center - t).norm(), 1e-8);
    const Eigen::Vector3d beside = center + Eigen::Vector3d(1, 0, 0);
    EXPECT_LT((P * beside - center - t - someRotation().col(0)).norm(), 1e-8);
  }
}

TEST(FrameCheck, AcceptsMotionUpToTheBoundAndItsSlack) {
  const PerturbationBounds bounds{{0, 1}, {0, 30}};
  EXPECT_DOUBLE_EQ(maxCentroidMotion(bounds), 1.3);
  const auto moving = [](double t) {
    return makePerturbation(kFarCenter, {0, 0, t}, someRotation());
  };
  EXPECT_NO_THROW(checkFrame(moving(1.299), kFarCenter, bounds));
  EXPECT_THROW(checkFrame(moving(1.301), kFarCenter, bounds), InvalidProblem);
}

TEST(FrameCheck, ExplainsCloudsInAnotherFrame) {
  const Transform P = makePerturbation(2.0 * kFarCenter, {0, 0, 0.5}, someRotation());
  try {
    checkFrame(P, kFarCenter, {{0, 1}, {0, 30}});
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
    cloud.points.push_back(kFarCenter + Eigen::Vector3d(0.125 * (i % 5), 0.25 * (i % 2), 0.0));
  }
  EXPECT_LT((centroid(cloud) - kFarCenter - Eigen::Vector3d(0.25, 0.125, 0.0)).norm(), 2e-9);
  EXPECT_THROW(centroid(DatasetCloud{}), InvalidProblem);
}

constexpr PerturbationBounds kLocal{{0, 3}, {0, 30}};
constexpr PerturbationBounds kGlobal{{5, 20}, {45, 180}};
constexpr int kSamples = 20000;

struct Drawn {
  std::vector<Eigen::Vector3d> translations;  ///< directions
  std::vector<Eigen::Vector3d> axes;
  std::vector<double> distances;  ///< fraction of the bounds' range
  std::vector<double> angles;     ///< fraction of the bounds' range
};

double part(double value, const Range& range) {
  return (value - range.min) / (range.max - range.min);
}

/// Taken apart again from the transforms, so that sampling and composition are tested together.
Drawn draw(const PerturbationBounds& bounds) {
  Drawn drawn;
  Random random(42);
  for (int i = 0; i < kSamples; ++i) {
    const Transform P = samplePerturbation(kFarCenter, bounds, random);
    const Eigen::Vector3d t = P * kFarCenter - kFarCenter;
    const Eigen::AngleAxisd rotation(P.rotation());
    drawn.translations.push_back(t.normalized());
    drawn.axes.push_back(rotation.axis());
    drawn.distances.push_back(part(t.norm(), bounds.translation));
    drawn.angles.push_back(part(rotation.angle() * 180.0 / M_PI, bounds.rotation_deg));
  }
  return drawn;
}

/// Chi-square of the counts in 200 cells of equal area on the sphere: z and azimuth are uniform.
/// With 199 degrees of freedom it is below 267 in 999 of 1000 cases.
double chiSquareOfDirections(const std::vector<Eigen::Vector3d>& directions) {
  constexpr int kRings = 10;
  constexpr int kSectors = 20;
  std::vector<int> counts(kRings * kSectors, 0);
  for (const auto& direction : directions) {
    const int ring =
        std::clamp(static_cast<int>((direction.z() + 1.0) / 2.0 * kRings), 0, kRings - 1);
    const double turn = (std::atan2(direction.y(), direction.x()) + M_PI) / (2.0 * M_PI);
    const int sector = std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1);
    const int cell = ring * kSectors + sector;
    ++counts[static_cast<std::size_t>(cell)];
  }
  const double expected = static_cast<double>(directions.size()) / (kRings * kSectors);
  double sum = 0.0;
  for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}
constexpr double kChiSquareLimit = 267.0;

/// Kolmogorov and Smirnov's distance of a sample from the uniform distribution on [0, 1], times √n:
/// below 1.95 in 999 of 1000 cases.
double kolmogorovSmirnov(std::vector<double> sample) {
  std::sort(sample.begin(), sample.end());
  const double n = static_cast<double>(sample.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    distance = std::max({distance, sample[i] - static_cast<double>(i) / n,
                         static_cast<double>(i + 1) / n - sample[i]});
  }
  return distance * std::sqrt(n);
}
constexpr double kKolmogorovSmirnovLimit = 1.95;

TEST(PerturbationSampling, DirectionsAndAxesAreUniformOnTheSphere) {
  for (const PerturbationBounds& bounds : {kLocal, kGlobal}) {
    const Drawn drawn = draw(bounds);
    EXPECT_LT(chiSquareOfDirections(drawn.translations), kChiSquareLimit);
    EXPECT_LT(chiSquareOfDirections(drawn.axes), kChiSquareLimit);
  }
}

/// What upstream's sampler does: the test above would find it.
TEST(PerturbationSampling, UniformInclinationIsNotUniformOnTheSphere) {
  Random random(42);
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < kSamples; ++i) {
    const double inclination = random.uniform(0.0, M_PI);
    const double azimuth = random.uniform(0.0, 2.0 * M_PI);
    directions.emplace_back(std::sin(inclination) * std::cos(azimuth),
                            std::sin(inclination) * std::sin(azimuth), std::cos(inclination));
  }
  EXPECT_GT(chiSquareOfDirections(directions), 10.0 * kChiSquareLimit);
}

TEST(PerturbationSampling, MagnitudesAreUniformBetweenTheirBounds) {
  for (const PerturbationBounds& bounds : {kLocal, kGlobal}) {
    const Drawn drawn = draw(bounds);
    EXPECT_LT(kolmogorovSmirnov(drawn.distances), kKolmogorovSmirnovLimit);
    EXPECT_LT(kolmogorovSmirnov(drawn.angles), kKolmogorovSmirnovLimit);
    for (const auto* fractions : {&drawn.distances, &drawn.angles}) {
      EXPECT_GE(*std::min_element(fractions->begin(), fractions->end()), -1e-6);
      EXPECT_LE(*std::max_element(fractions->begin(), fractions->end()), 1.0 + 1e-6);
    }
  }
}

TEST(PerturbationSampling, TranslationAndRotationAreIndependent) {
  const Drawn drawn = draw(kLocal);
  double dot = 0.0;
  double product = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    dot += drawn.translations[i].dot(drawn.axes[i]);
    product += (drawn.distances[i] - 0.5) * (drawn.angles[i] - 0.5) * 12.0;
  }
  EXPECT_LT(std::abs(dot / kSamples), 4.0 * std::sqrt(1.0 / 3.0 / kSamples));
  EXPECT_LT(std::abs(product / kSamples), 4.0 * std::sqrt(1.0 / kSamples));
}

ProblemList someList(Kind kind) {
  ProblemList list{"plain", kind, {}, kind == Kind::kLocal ? kLocal : kGlobal};
  for (int i = 0; i < 100; ++i) {
    list.pairs.push_back({"PointCloud" + std::to_string(i) + ".pcd", "PointCloud0.pcd", 0.5});
  }
  return list;
}

Eigen::Vector3d someCentroid(const std::string& source) {
  return kFarCenter + Eigen::Vector3d(static_cast<double>(source.size()), 0, 0);
}

TEST(ProblemSampling, HasThePublishedIdsAndCounts) {
  const auto local = sampleProblems(someList(Kind::kLocal), 1, someCentroid);
  ASSERT_EQ(local.size(), 3000U);
  EXPECT_EQ(local[0].id, "4215528470000");
  EXPECT_EQ(local[30].id, "4215528470031");
  EXPECT_EQ(local[2999].id, "4215528473098");
  const auto global = sampleProblems(someList(Kind::kGlobal), 1, someCentroid);
  ASSERT_EQ(global.size(), 100U);
  EXPECT_EQ(global[0].id, "4215528470030");
  EXPECT_EQ(global[99].id, "4215528473099");
}

TEST(ProblemSampling, RotatesAboutTheSourcesCentroid) {
  for (const Kind kind : {Kind::kLocal, Kind::kGlobal}) {
    const ProblemList list = someList(kind);
    for (const Problem& problem : sampleProblems(list, 3, someCentroid)) {
      const Transform P = requireRigid(problem.perturbation);
      const Eigen::Vector3d center = someCentroid(problem.source);
      const double moved = (P * center - center).norm();
      EXPECT_GE(moved, list.bounds.translation.min - 1e-8);
      EXPECT_LE(moved, list.bounds.translation.max + 1e-8);
      EXPECT_NO_THROW(checkFrame(P, center, list.bounds));
    }
  }
}

TEST(ProblemSampling, SameSeedGivesTheSameBytesAndListsAreIndependent) {
  const auto text = [](Kind kind, std::uint64_t seed) {
    return formatProblemFile(sampleProblems(someList(kind), seed, someCentroid));
  };
  EXPECT_EQ(text(Kind::kLocal, 5), text(Kind::kLocal, 5));
  EXPECT_NE(text(Kind::kLocal, 5), text(Kind::kLocal, 6));
  std::set<std::uint64_t> seeds;
  for (const char* purpose :
       {"a local pairs", "a global pairs", "b local pairs", "a local perturbations"}) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) seeds.insert(streamSeed(seed, purpose));
  }
  EXPECT_EQ(seeds.size(), 400U);
}

}  // namespace
}  // namespace pcrb
