// All methods on one real pair, the first problem of automotive/street of the shared data, 8 k
// points in either cloud after a voxel grid of 0.2 m; then their accuracy (`accuracy/…`) on a part
// of the real problems, every method with its default parameters and the data set's leaf. Peers:
// PCL's own classes where a method is built on them, else a figure that was measured elsewhere
// (counter `peer_ms`, see docs/benchmarks.md).
//
//   PCRB_SHARED_DATA=/path/to/shared/data registration_benchmark

#include <benchmark/benchmark.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/registration/registration.hpp"
#include "real_pairs.hpp"
#include "registration/pcl_common.hpp"

namespace {

using pcrb::Transform;
using pcrb_benchmark::RealSequence;
using Point = pcl::PointXYZ;

constexpr double kDegrees = 180.0 / M_PI;

const RealSequence::Pair& pairOf(const std::string& kind) {
  static const RealSequence::Pair local = RealSequence("automotive/street", "local").pair(0);
  static const RealSequence::Pair global = RealSequence("automotive/street", "global").pair(0);
  return kind == "local" ? local : global;
}

void report(benchmark::State& state, const RealSequence::Pair& pair, const Transform& T) {
  const auto error = pcrb_benchmark::scoreOf(pair, T);
  state.counters["rotation_deg"] = error.rotation_error * kDegrees;
  state.counters["translation_m"] = error.translation_error;
}

struct Case {
  std::string method;
  std::string kind;
  std::string leaf;  ///< m
  double peer_ms;    ///< with one core; 0 for none
  int threads;
};

/// Target and source work of a pair that is new in both.
void align(benchmark::State& state, const Case& one) {
  const RealSequence::Pair& pair = pairOf(one.kind);
  const auto method = pcrb::makeRegistration(
      one.method, {{"threads", std::to_string(one.threads)}, {"voxel_leaf", one.leaf}});
  pcrb::RegistrationResult result;
  double solver_time = 0.0;
  for (auto step : state) {
    method->setTarget(pair.target);
    result = method->align(pair.source, Transform::Identity());
    solver_time += result.solver_time;
  }
  report(state, pair, result.T_target_source);
  state.counters["iterations"] = result.iterations;
  state.counters["align_ms"] =
      benchmark::Counter(1e3 * solver_time, benchmark::Counter::kAvgIterations);
  if (one.peer_ms > 0.0) state.counters["peer_ms"] = one.peer_ms;
}

struct AccuracyCase {
  std::string method;
  std::string sequence;
  std::string kind;
  std::string leaf;  ///< m
  std::size_t step;  ///< every step-th problem of the file
};

double medianOf(std::vector<double> values) { return pcrb::describe(std::move(values)).median; }

/// Medians over problems; one that the method cannot solve counts with its initial misalignment.
void measureAccuracy(benchmark::State& state, const AccuracyCase& one) {
  RealSequence sequence(one.sequence, one.kind);
  const auto method = pcrb::makeRegistration(one.method, {{"voxel_leaf", one.leaf}});
  std::vector<double> errors, degrees, meters;
  for (auto step : state) {
    for (std::size_t i = 0; i < sequence.size(); i += one.step) {
      const RealSequence::Pair pair = sequence.pair(i);
      Transform T = Transform::Identity();
      method->setTarget(pair.target);
      try {
        T = method->align(pair.source, T).T_target_source;
      } catch (const pcrb::RegistrationFailed&) {
        state.counters["failed"] += 1.0;
      }
      const auto score = pcrb_benchmark::scoreOf(pair, T);
      errors.push_back(score.error);
      degrees.push_back(score.rotation_error * kDegrees);
      meters.push_back(score.translation_error);
    }
  }
  state.counters["problems"] = static_cast<double>(errors.size());
  state.counters["solved"] = static_cast<double>(
      std::count_if(errors.begin(), errors.end(), [](double error) { return error < 0.1; }));
  state.counters["median_error"] = medianOf(errors);
  state.counters["median_deg"] = medianOf(degrees);
  state.counters["median_m"] = medianOf(meters);
}

/// PCL's class as it is, on the clouds that our method gives to its own.
template <class PclMethod>
void alignWithPcl(benchmark::State& state, bool filter_target,
                  const std::function<void(PclMethod&)>& configure) {
  constexpr double kLeaf = 0.2;
  constexpr int kMaxIterations = 35;
  const RealSequence::Pair& pair = pairOf("local");
  Transform T = Transform::Identity();
  for (auto step : state) {
    const auto& points = pair.target->points;
    PclMethod method;
    configure(method);
    method.setMaximumIterations(kMaxIterations);
    method.setInputTarget(pcrb::toPcl(filter_target ? pcrb::voxelGrid(points, kLeaf) : points));
    method.setInputSource(pcrb::toPcl(pcrb::voxelGrid(pair.source.points, kLeaf)));
    pcrb::PclCloud aligned;
    method.align(aligned);
    T = Transform(method.getFinalTransformation().template cast<double>());
    T.linear() = pcrb::nearestRotation(T.linear());
  }
  report(state, pair, T);
}

void pclIcp(benchmark::State& state) {
  using Icp = pcl::IterativeClosestPoint<Point, Point, double>;
  alignWithPcl<Icp>(state, true, [](Icp& icp) { icp.setTransformationEpsilon(1e-4); });
}

void pclGicp(benchmark::State& state) {
  using Gicp = pcl::GeneralizedIterativeClosestPoint<Point, Point, double>;
  alignWithPcl<Gicp>(state, true, [](Gicp& gicp) { gicp.setTransformationEpsilon(0.01); });
}

void pclNdt(benchmark::State& state) {
  using Ndt = pcl::NormalDistributionsTransform<Point, Point, double>;
  alignWithPcl<Ndt>(state, false, [](Ndt& ndt) {
    ndt.setResolution(0.2F);
    ndt.setTransformationEpsilon(1e-4);
  });
}

void registerCase(const Case& one) {
  const std::string name =
      one.method + "/leaf:" + one.leaf + "/threads:" + std::to_string(one.threads);
  benchmark::RegisterBenchmark(name.c_str(), [one](benchmark::State& state) { align(state, one); })
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

void registerAccuracy(const std::vector<const char*>& methods, const std::string& kind,
                      std::size_t step) {
  const std::vector<std::pair<const char*, const char*>> sequences{
      {"automotive/street", "0.2"}, {"handheld/car", "0.2"}, {"rgbd/livingroom", "0.1"}};
  for (const auto& [sequence, leaf] : sequences) {
    for (const char* method : methods) {
      const AccuracyCase one{method, sequence, kind, leaf, step};
      const std::string name = std::string("accuracy/") + sequence + "/" + kind + "/" + method;
      benchmark::RegisterBenchmark(name.c_str(),
                                   [one](benchmark::State& state) { measureAccuracy(state, one); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1);
    }
  }
}

void registerAll() {
  struct Method {
    const char* name;
    const char* kind;
    double peer_ms;
  };
  // Measured on one core, 8 k points: PCL, the authors' PPCR, Open3D's RANSAC and FGR, a prototype
  // of TEASER.
  constexpr Method kMethods[] = {{"icp", "local", 322},     {"gicp", "local", 118},
                                 {"ndt", "local", 448},     {"ppcr", "local", 8700},
                                 {"ransac", "global", 600}, {"fgr", "global", 827},
                                 {"teaser", "global", 815}};
  for (const auto& method : kMethods) {
    for (const int threads : {1, 2}) {
      registerCase({method.name, method.kind, "0.2", method.peer_ms, threads});
    }
  }
  for (const int threads : {1, 2}) registerCase({"ppcr", "local", "0.07", 0.0, threads});
}

BENCHMARK(pclIcp)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(pclGicp)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(pclNdt)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  if (std::getenv("PCRB_SHARED_DATA") == nullptr) {
    std::fprintf(stderr, "registration_benchmark: PCRB_SHARED_DATA is not set\n");
    return 1;
  }
  registerAll();
  registerAccuracy({"icp", "gicp", "ndt", "ppcr"}, "local", 5);
  registerAccuracy({"ransac", "fgr", "teaser"}, "global", 1);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
