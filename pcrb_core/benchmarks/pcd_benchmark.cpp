// Loading a sequence's cloud (docs/benchmarks.md): an ASCII PCD file of 365,000 points and 21 MB,
// as writePcd makes it, with pcl::io::loadPCDFile and with readPcd on one and on two threads. The
// file is in the page cache for all of them.

#include <benchmark/benchmark.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/random.hpp"
#include "ratio_reporter.hpp"

namespace {

constexpr std::size_t kPoints = 365000;

/// The file, while the program runs. Its coordinates have all the digits of a double, as those of
/// scans that were turned into the world's frame do.
class BenchmarkFile {
 public:
  BenchmarkFile() : path_(makePath()) {
    pcrb::Random random(1);
    pcrb::DatasetCloud cloud;
    for (std::size_t i = 0; i < kPoints; ++i) {
      cloud.points.push_back(random.direction() * random.uniform(0.5, 60.0));
    }
    pcrb::writePcd(path_, cloud);
    std::printf("%zu points, %ju bytes\n", kPoints, std::filesystem::file_size(path_));
  }
  ~BenchmarkFile() { std::filesystem::remove(path_); }
  BenchmarkFile(const BenchmarkFile&) = delete;
  BenchmarkFile& operator=(const BenchmarkFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  static std::string makePath() {
    const std::string name = "pcrb_pcd_benchmark_" + std::to_string(getpid()) + ".pcd";
    return (std::filesystem::temp_directory_path() / name).string();
  }

  std::string path_;
};

const std::string& path() {
  static const BenchmarkFile file;
  return file.path();
}

void pclLoad(benchmark::State& state) {
  path();
  for (auto _ : state) {
    pcl::PointCloud<pcl::PointXYZ> cloud;
    if (pcl::io::loadPCDFile(path(), cloud) != 0 || cloud.size() != kPoints) {
      state.SkipWithError("PCL did not read the file");
    }
    benchmark::DoNotOptimize(cloud.points.data());
  }
}

void load(benchmark::State& state, int threads) {
  path();
  for (auto _ : state) {
    const pcrb::DatasetCloud cloud = pcrb::readPcd(path(), {threads});
    if (cloud.points.size() != kPoints) state.SkipWithError("readPcd lost points");
    benchmark::DoNotOptimize(cloud.points.data());
  }
}

void readPcdOneThread(benchmark::State& state) { load(state, 1); }
void readPcdTwoThreads(benchmark::State& state) { load(state, 2); }

// Alternating, so that what else the machine does meets all alike.
BENCHMARK(pclLoad)->Unit(benchmark::kMillisecond)->Iterations(3)->Repetitions(9);
BENCHMARK(readPcdOneThread)->Unit(benchmark::kMillisecond)->Iterations(20)->Repetitions(9);
BENCHMARK(readPcdTwoThreads)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(20)
    ->Repetitions(9);

}  // namespace

int main(int argc, char** argv) {
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.push_back(interleave.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;
  pcrb_benchmark::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.printCpuRatio("pclLoad", "readPcdOneThread");
  reporter.printRealRatio("pclLoad", "readPcdOneThread");
  reporter.printRealRatio("pclLoad", "readPcdTwoThreads");
  return 0;
}
