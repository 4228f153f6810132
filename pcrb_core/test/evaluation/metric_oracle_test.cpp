// The metric against eq. 1 written out in long double: transform all points, take the centroid of
// the result, sum the ratios.

#include <gtest/gtest.h>

#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

using Vector = Eigen::Matrix<long double, 3, 1>;
using Rows = Eigen::Matrix<long double, 3, 4>;

struct Oracle {
  long double error = 0.0L;
  long double unnormalized = 0.0L;
  long double translation_error = 0.0L;
};

/// @param origin  added to the stored points: the oracle works in the data set's frame.
Oracle evaluate(const PointCloud& source, const Eigen::Vector3d& origin, const Transform& T) {
  const Rows rows = T.matrix().topRows<3>().cast<long double>();
  const auto truth = [&](const Eigen::Vector3f& p) -> Vector {
    return p.cast<long double>() + origin.cast<long double>();
  };
  const auto moved = [&](const Eigen::Vector3f& p) -> Vector {
    return rows.leftCols<3>() * truth(p) + rows.col(3);
  };
  const auto n = static_cast<long double>(source.size());
  Vector truth_centroid = Vector::Zero();
  Vector centroid = Vector::Zero();
  for (const auto& p : source.points) truth_centroid += truth(p) / n;
  for (const auto& p : source.points) centroid += moved(p) / n;
  Oracle oracle;
  for (const auto& p : source.points) {
    const long double distance = (moved(p) - truth(p)).norm();
    oracle.error += distance / (moved(p) - centroid).norm() / n;
    oracle.unnormalized += distance / n;
  }
  oracle.translation_error = (centroid - truth_centroid).norm();
  return oracle;
}

/// Points around a centre, none closer than `blind` · `extent`, denser towards it like a lidar's.
DatasetCloud scan(Random& random, double extent, const Eigen::Vector3d& center, double blind) {
  DatasetCloud cloud;
  for (int i = 0; i < 5000; ++i) {
    const double radius = extent * random.uniform(blind, 1.0);
    cloud.points.push_back(center + random.direction() * radius);
  }
  return cloud;
}

/// A motion about a centre, of any size from a perfect reply's rounding to a global perturbation.
Transform anyMotion(Random& random, const Eigen::Vector3d& center) {
  const double size = std::pow(10.0, random.uniform(-12.0, 0.5));
  const Eigen::AngleAxisd turn(std::min(3.1, size), random.direction());
  return makePerturbation(center, random.direction() * size * 5.0, turn.toRotationMatrix());
}

TEST(MetricOracle, AgreesOnTheStoredPoints) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double extent = std::pow(10.0, random.uniform(-1.0, 2.0));
    const Eigen::Vector3d center = random.direction() * random.uniform(0.0, 1000.0);
    const PointCloud cloud = makeLocal(scan(random, extent, center, 0.0), Eigen::Vector3d::Zero());
    const Transform T = anyMotion(random, center);
    const Metric metric(cloud);
    const PoseError found = metric.evaluate(T);
    const Oracle oracle = evaluate(cloud, Eigen::Vector3d::Zero(), T);
    const double error = static_cast<double>(oracle.error);
    EXPECT_NEAR(found.error, error, 1e-12 + 1e-11 * error) << "extent " << extent;
    const double translation_error = static_cast<double>(oracle.translation_error);
    EXPECT_NEAR(found.translation_error, translation_error, 1e-12 + 1e-11 * translation_error);
    const double unnormalized = static_cast<double>(oracle.unnormalized);
    EXPECT_NEAR(metric.unnormalized(T), unnormalized, 1e-12 + 1e-11 * unnormalized);
  }
}

TEST(MetricOracle, AgreesWithCloudsAndPerturbationShiftedByTenThousandKilometres) {
  Random random(2);
  const Eigen::Vector3d far(1e7, -1e7, 1e7);
  for (int i = 0; i < 100; ++i) {
    const double extent = std::pow(10.0, random.uniform(-1.0, 2.0));
    const Eigen::Vector3d center = far + random.direction() * random.uniform(0.0, 300.0);
    // At 1e7 m the oracle itself keeps 1e-12 m: too little for points next to the centroid.
    const DatasetCloud dataset_cloud = scan(random, extent, center, 0.02);
    const Transform P = anyMotion(random, center);
    const Eigen::Vector3d origin = chooseLocalOrigin(dataset_cloud);
    const PointCloud cloud = makeLocal(dataset_cloud, origin);
    const Metric metric(cloud);
    const PoseError found = metric.evaluate(inLocalFrame(P, origin));
    const Oracle oracle = evaluate(cloud, origin, P);
    const double error = static_cast<double>(oracle.error);
    EXPECT_NEAR(found.error, error, 1e-9 + 1e-9 * error) << "extent " << extent;
    EXPECT_NEAR(found.translation_error, static_cast<double>(oracle.translation_error), 1e-9);
  }
}

TEST(MetricOracle, LosesLessThanATenthOfAMillimetreToTheStorageOfUtmClouds) {
  Random random(3);
  const Eigen::Vector3d center(702000.3, 8045000.7, 30.1);
  const DatasetCloud dataset_cloud = scan(random, 120.0, center, 0.0);
  const Eigen::Vector3d origin = chooseLocalOrigin(dataset_cloud);
  const PointCloud cloud = makeLocal(dataset_cloud, origin);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d stored = cloud.points[i].cast<double>() + origin;
    EXPECT_LT((stored - dataset_cloud.points[i]).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace pcrb
