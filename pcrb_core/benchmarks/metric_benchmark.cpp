// The metric of one reply to a problem of 365,000 points (docs/benchmarks.md), against the formula
// written with PCL: the source is transformed, the result's centroid taken, the ratios of
// pcl::euclideanDistance summed. Both get the pose and the source at ground truth.

#include <benchmark/benchmark.h>
#include <pcl/common/centroid.h>
#include <pcl/common/distances.h>
#include <pcl/common/transforms.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/random.hpp"
#include "ratio_reporter.hpp"

namespace {

constexpr std::size_t kPoints = 365000;

/// A cloud like a tilting lidar's: all distances from 0.5 m to 30 m around its sensor.
const pcrb::PointCloud& source() {
  static const pcrb::PointCloud cloud = [] {
    pcrb::Random random(1);
    pcrb::PointCloud made;
    for (std::size_t i = 0; i < kPoints; ++i) {
      made.points.push_back((random.direction() * random.uniform(0.5, 30.0)).cast<float>());
    }
    return made;
  }();
  return cloud;
}

pcrb::Transform residual() {
  return pcrb::makeTransform({0.2, -0.1, 0.05}, Eigen::Quaterniond(0.99, 0.05, -0.02, 0.1));
}

const pcl::PointCloud<pcl::PointXYZ>& pclSource() {
  static const pcl::PointCloud<pcl::PointXYZ> cloud = [] {
    pcl::PointCloud<pcl::PointXYZ> made;
    for (const auto& p : source().points) made.emplace_back(p.x(), p.y(), p.z());
    return made;
  }();
  return cloud;
}

/// Equation 1 on two corresponding clouds.
double pclError(const pcl::PointCloud<pcl::PointXYZ>& moved,
                const pcl::PointCloud<pcl::PointXYZ>& truth) {
  pcl::PointXYZ centroid;
  pcl::computeCentroid(moved, centroid);
  double sum = 0.0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    sum += pcl::euclideanDistance(moved[i], truth[i]) / pcl::euclideanDistance(moved[i], centroid);
  }
  return sum / static_cast<double>(moved.size());
}

void pclFormula(benchmark::State& state) {
  const auto& truth = pclSource();
  const Eigen::Affine3f T(residual().matrix().cast<float>());
  pcl::PointCloud<pcl::PointXYZ> moved;
  for (auto step : state) {
    pcl::transformPointCloud(truth, moved, T);
    benchmark::DoNotOptimize(pclError(moved, truth));
  }
}

/// The peer's loop alone, on a cloud that has been moved already.
void pclFormulaOnMovedCloud(benchmark::State& state) {
  const auto& truth = pclSource();
  pcl::PointCloud<pcl::PointXYZ> moved;
  pcl::transformPointCloud(truth, moved, Eigen::Affine3f(residual().matrix().cast<float>()));
  for (auto step : state) benchmark::DoNotOptimize(pclError(moved, truth));
}

void metricPerReply(benchmark::State& state) {
  const pcrb::Metric metric(source());
  const pcrb::Transform T = residual();
  for (auto step : state) benchmark::DoNotOptimize(metric.evaluate(T).error);
}

void metricOncePerSource(benchmark::State& state) {
  const pcrb::PointCloud& cloud = source();
  for (auto step : state) benchmark::DoNotOptimize(pcrb::Metric(cloud).weighted());
}

BENCHMARK(pclFormula)->Unit(benchmark::kMillisecond);
BENCHMARK(pclFormulaOnMovedCloud)->Unit(benchmark::kMillisecond);
BENCHMARK(metricPerReply)->Unit(benchmark::kMillisecond);
BENCHMARK(metricOncePerSource)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  pcrb_benchmark::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.printCpuRatio("pclFormula", "metricPerReply");
  reporter.printCpuRatio("pclFormulaOnMovedCloud", "metricPerReply");
  return 0;
}
