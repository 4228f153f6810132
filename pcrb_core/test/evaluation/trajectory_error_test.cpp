#include "pcrb_core/evaluation/trajectory_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr double kDegree = 180.0 / 3.14159265358979323846;

constexpr const char* kTruth =
    "1000000000.0 0.000000 0.000000 0.200000 0.000000 0.000000 0.000000 1.000000\n"
    "1000000000.5 1.000000 0.719138 0.108060 0.009889 0.009482 0.098889 0.995004\n"
    "1000000001.0 2.000000 1.262206 -0.083229 0.019497 0.032812 0.194969 0.980067\n"
    "1000000001.5 3.000000 1.496242 -0.197998 0.028843 0.057541 0.288426 0.955336\n"
    "1000000002.0 4.000000 1.363946 -0.130729 0.038129 0.069342 0.381293 0.921061\n"
    "1000000002.5 5.000000 0.897708 0.056732 0.047370 0.056699 0.473698 0.877583\n"
    "1000000003.0 6.000000 0.211680 0.192034 0.056162 0.015851 0.561619 0.825336\n"
    "1000000003.5 7.000000 -0.526175 0.150780 0.063946 -0.044863 0.639464 0.764842\n"
    "1000000004.0 8.000000 -1.135204 -0.029100 0.070584 -0.106836 0.705836 0.696707\n";

constexpr const char* kEstimate =
    "1000000000.0 0.300098 -0.076100 0.228069 -0.007275 -0.003714 -0.008100 0.999934\n"
    "1000000000.5 1.407217 0.579762 0.108422 0.034378 0.031236 0.104444 0.993445\n"
    "1000000001.0 2.297660 1.217831 -0.140767 0.016594 -0.013329 0.163913 0.986245\n"
    "1000000001.5 3.281193 1.294847 -0.126297 0.029381 0.056961 0.265900 0.961868\n"
    "1000000002.0 4.296120 1.273011 -0.203140 -0.034792 -0.040961 -0.360872 -0.931066\n"
    "1000000002.5 5.235397 0.795106 0.177484 0.038677 0.049411 0.476060 0.877172\n"
    "1000000003.0 6.201996 0.117771 0.350740 0.030346 0.013405 0.563943 0.825147\n"
    "1000000003.5 7.460033 -0.565194 0.104837 0.050493 -0.022672 0.634618 0.770842\n"
    "1000000004.0 8.294679 -1.181824 0.135982 0.061760 -0.111553 0.699830 0.702837\n";

Poses posesOf(const char* text) {
  const Trajectory trajectory = parseTrajectory(text, "text").trajectory;
  Poses poses;
  for (int i = 0; i < 9; ++i) {
    poses.push_back(trajectory.nearest(1000000000 * kSecond + i * kSecond / 2).T_world_body);
  }
  return poses;
}

/// rmse, mean, median, std, min, max, sse as trajectory_oracle.py prints them.
void expectStatistics(const std::vector<double>& errors, const std::vector<double>& expected,
                      double unit = 1.0) {
  const ErrorStatistics s = describeErrors(errors);
  const std::vector<double> found{s.rmse, s.mean, s.median, s.stddev, s.min, s.max, s.sse};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double factor = i == 6 ? unit * unit : unit;
    EXPECT_NEAR(found[i] * factor, expected[i], 1e-9 * (1.0 + expected[i])) << "statistic " << i;
  }
}

TEST(TrajectoryError, AbsoluteErrorsAreTheOraclesOnes) {
  const PoseErrors errors = absolutePoseErrors(posesOf(kTruth), posesOf(kEstimate));
  expectStatistics(errors.translation,
                   {0.347785745806875, 0.342359040295876, 0.318118816711618, 0.061198141427097,
                    0.273512118073405, 0.463965087801873, 1.088594324878});
  expectStatistics(errors.rotation,
                   {3.41288179502002, 3.03904022241429, 2.98361637996386, 1.55306042166015,
                    1.31822741849603, 6.42212138528478, 104.829859321012},
                   kDegree);
}

TEST(TrajectoryError, AlignedErrorsAreTheOraclesOnes) {
  const Poses truth = posesOf(kTruth);
  const Poses aligned = alignToReference(truth, posesOf(kEstimate));
  expectStatistics(absolutePoseErrors(truth, aligned).translation,
                   {0.115452076938511, 0.106609444842285, 0.104120788853783, 0.0443126205480526,
                    0.0499404003461405, 0.204636164589424, 0.119962638624743});
}

TEST(TrajectoryError, RelativeErrorsAreTheOraclesOnes) {
  const PoseErrors errors = relativePoseErrors(posesOf(kTruth), posesOf(kEstimate), 1);
  expectStatistics(errors.translation,
                   {0.197057002888298, 0.170493410787533, 0.138423651069906, 0.0988102184257883,
                    0.0354845501867872, 0.372412876201674, 0.310651699098549});
  expectStatistics(errors.rotation,
                   {4.83670080172283, 4.34913911155391, 3.47442589323332, 2.11628533844998,
                    1.94546449879366, 9.29059612228489, 187.14939716309},
                   kDegree);
}

TEST(TrajectoryError, PairsFartherApartFollowEachOther) {
  const PoseErrors errors = relativePoseErrors(posesOf(kTruth), posesOf(kEstimate), 3);
  EXPECT_EQ(errors.translation.size(), 2U);
  expectStatistics(errors.translation,
                   {0.195937681495167, 0.177439068074562, 0.177439068074562, 0.0831080751222923,
                    0.0943309929522696, 0.260547143196854, 0.0767831500594032});
  EXPECT_TRUE(relativePoseErrors(posesOf(kTruth), posesOf(kEstimate), 9).rotation.empty());
}

TEST(TrajectoryError, AlignmentTakesAnyRigidMotionBack) {
  const Poses truth = posesOf(kTruth);
  const Transform T = makeTransform({3e5, -4e6, 12}, Eigen::Quaterniond(0.2, 0.4, -0.8, 0.1));
  Poses moved;
  for (const Transform& pose : truth) moved.push_back(T * pose);
  const PoseErrors errors = absolutePoseErrors(truth, alignToReference(truth, moved));
  EXPECT_LT(describeErrors(errors.translation).max, 1e-8);
  EXPECT_LT(describeErrors(errors.rotation).max, 1e-8);
}

TEST(TrajectoryError, AlignmentRefusesALine) {
  Poses line;
  for (int i = 0; i < 5; ++i) line.emplace_back(Eigen::Translation3d(i, 2.0 * i, 0.0));
  EXPECT_THROW(alignToReference(line, line), InvalidParameter);
}

/// Poses every metre along x; those of the estimate are `scale` apart and turn by `yaw` each.
Poses straight(std::size_t count, double scale, double yaw) {
  Poses poses{Transform::Identity()};
  while (poses.size() < count) {
    Transform motion(Eigen::Translation3d(scale, 0.0, 0.0));
    motion.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    poses.push_back(poses.back() * motion);
  }
  return poses;
}

TEST(TrajectoryError, RelativeErrorsOverMetresFollowThePath) {
  const PoseErrors errors =
      relativePoseErrorsOver(straight(11, 1.0, 0.0), straight(11, 1.1, 0.0), 2.5);
  ASSERT_EQ(errors.translation.size(), 3u);  // from 0 to 3, 6 and 9 m
  for (const double error : errors.translation) EXPECT_NEAR(error, 0.3, 1e-9);
  EXPECT_TRUE(relativePoseErrorsOver(straight(3, 1, 0), straight(3, 1, 0), 9).rotation.empty());
  EXPECT_THROW(relativePoseErrorsOver(straight(3, 1, 0), straight(3, 1, 0), 0), InvalidParameter);
}

TEST(TrajectoryError, DriftIsThatOfKitti) {
  // 5 % too long: a segment over more than L metres is ceil of L + 1 poses long, as the devkit's.
  const Poses truth = straight(1001, 1.0, 0.0);
  const Drift translation = drift(truth, straight(1001, 1.05, 0.0));
  EXPECT_EQ(translation.lengths, (std::vector<double>{100, 200, 300, 400, 500, 600, 700, 800}));
  std::size_t segments = 0;
  double sum = 0.0;
  for (int first = 0; first <= 1000; first += 10) {
    for (int length = 100; length <= 800; length += 100) {
      if (first + length + 1 > 1000) continue;
      sum += 0.05 * (length + 1) / length;
      ++segments;
    }
  }
  EXPECT_EQ(translation.segments, segments);
  EXPECT_NEAR(translation.translation_percent, 100.0 * sum / static_cast<double>(segments), 1e-9);
  const Drift rotation = drift(truth, straight(1001, 1.0, 0.001 / kDegree));
  EXPECT_NEAR(rotation.rotation_degrees_per_metre, 0.001, 2e-5);
  const Drift shorter = drift(straight(91, 1.0, 0.0), straight(91, 1.05, 0.0));
  EXPECT_EQ(shorter.lengths.front(), 10.0) << "a tenth of KITTI's";
  EXPECT_EQ(shorter.lengths.back(), 80.0);
  const Drift sequence03 = drift(straight(562, 1.0, 0.0), straight(562, 1.05, 0.0));
  EXPECT_EQ(sequence03.lengths, (std::vector<double>{100, 200, 300, 400, 500}))
      << "KITTI's own sequences can be shorter than 800 m";
  EXPECT_EQ(sequence03.segments, 47u + 37 + 27 + 17 + 7);
  EXPECT_EQ(drift(straight(2, 1, 0), straight(2, 1, 0), {5.0}).segments, 0u);
  EXPECT_TRUE(std::isnan(drift(straight(2, 1, 0), straight(2, 1, 0), {5.0}).translation_percent));
  EXPECT_THROW(drift(truth, truth, {-1.0}), InvalidParameter);
}

TEST(TrajectoryError, RefusesTrajectoriesThatDoNotMatch) {
  const Poses truth = posesOf(kTruth);
  EXPECT_THROW(absolutePoseErrors(truth, Poses(8, Transform::Identity())), InvalidParameter);
  EXPECT_THROW(absolutePoseErrors({}, {}), InvalidParameter);
  EXPECT_THROW(relativePoseErrors(truth, truth, 0), InvalidParameter);
}

TEST(TrajectoryError, NoErrorHasNoStatistics) {
  EXPECT_EQ(describeErrors({}).count, 0U);
  EXPECT_TRUE(std::isnan(describeErrors({}).rmse));
}

}  // namespace
}  // namespace pcrb
