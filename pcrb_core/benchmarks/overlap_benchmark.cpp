// Makes the scans that overlap is measured on and times their overlap matrix. overlap_peer.py runs
// this and scipy's k-d tree on the same scans and prints the ratio.
//
//   overlap_benchmark SCENE CLOUDS POINTS THREADS FOLDER
//
// SCENE is room or terrain. Writes the scans as FOLDER/<i>.f64 (x y z in double) and the counts as
// FOLDER/counts.txt, a row per target; prints the seconds of each stage.

#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "pcrb_core/parallel.hpp"
#include "search/coverage.hpp"
#include "synthetic_scans.hpp"

namespace {

using Points = std::vector<Eigen::Vector3d>;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of all threads: what a machine that others use does not lengthen.
double processorSeconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;  // from KiB
}

void write(const std::string& path, const Points& points) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(points.data()),
             static_cast<std::streamsize>(points.size() * sizeof(Eigen::Vector3d)));
}

std::vector<pcrb::CellGrid> makeGrids(const std::vector<Points>& clouds, double distance,
                                      int threads) {
  std::vector<std::vector<pcrb::CellGrid>> grids(clouds.size());
  pcrb::parallelFor(clouds.size(), threads, [&](std::size_t i) {
    grids[i].emplace_back(clouds[i], clouds[0][0], distance);
  });
  std::vector<pcrb::CellGrid> result;
  for (auto& grid : grids) result.push_back(std::move(grid.front()));
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::cerr << "overlap_benchmark SCENE CLOUDS POINTS THREADS FOLDER\n";
    return 2;
  }
  const pcrb_benchmark::SyntheticScans scene(argv[1]);
  const auto n = static_cast<std::size_t>(std::atoi(argv[2]));
  const auto points = static_cast<std::size_t>(std::atoi(argv[3]));
  const int threads = std::atoi(argv[4]);
  const std::string folder = argv[5];

  std::vector<Points> clouds(n);
  pcrb::parallelFor(n, threads, [&](std::size_t i) {
    clouds[i] = scene.scan(static_cast<int>(i), points);
    write(folder + "/" + std::to_string(i) + ".f64", clouds[i]);
  });

  const double before = peakMegabytes();
  const double processor_start = processorSeconds();
  const auto start = std::chrono::steady_clock::now();
  const std::vector<pcrb::CellGrid> grids = makeGrids(clouds, scene.distance(), threads);
  const double grid_seconds = secondsSince(start);
  std::vector<std::vector<std::size_t>> counts(n, std::vector<std::size_t>(n, 0));
  pcrb::parallelFor(n, threads, [&](std::size_t target) {
    const pcrb::Coverage coverage(grids[target]);
    for (std::size_t source = 0; source < n; ++source) {
      if (source != target) counts[target][source] = coverage.count(grids[source]);
    }
  });
  const double seconds = secondsSince(start);
  const double processor_seconds = processorSeconds() - processor_start;

  std::ofstream file(folder + "/counts.txt");
  for (const auto& row : counts) {
    for (const std::size_t count : row) file << count << ' ';
    file << '\n';
  }
  std::size_t held = 0;
  for (const auto& grid : grids) held += grid.bytes();
  std::cout << "distance " << scene.distance() << "\ngrid_seconds " << grid_seconds << "\nseconds "
            << seconds << "\nprocessor_seconds " << processor_seconds << "\ngrid_megabytes "
            << static_cast<double>(held) / 1e6 << "\npeak_growth_megabytes "
            << peakMegabytes() - before << "\n";
  return file.good() ? 0 : 1;
}
