#include "pcrb_core/problem/overlap.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/parallel.hpp"
#include "search/coverage.hpp"

namespace pcrb {
namespace {

double shareOf(std::size_t count, std::size_t size) {
  return static_cast<double>(count) / static_cast<double>(size);
}

/// Positions [first, end) in a sequence.
struct Span {
  std::size_t first;
  std::size_t end;
};

Span sourcesOf(const OverlapJob& job, std::size_t target) {
  if (job.window == 0) return {0, job.files.size()};
  return {target - std::min(target, job.window),
          std::min(job.files.size(), target + job.window + 1)};
}

/// The clouds that are held at the moment.
class HeldClouds {
 public:
  HeldClouds(const OverlapJob& job, const OverlapEvents& events)
      : job_(job), events_(events), grids_(job.files.size()) {}

  const CellGrid& operator[](std::size_t cloud) const { return *grids_[cloud]; }

  /// Reads what is missing of the span and drops what is before it.
  void hold(Span span) {
    for (std::size_t i = 0; i < span.first; ++i) grids_[i].reset();
    std::vector<std::size_t> missing;
    for (std::size_t i = span.first; i < span.end; ++i) {
      if (!grids_[i]) missing.push_back(i);
    }
    if (missing.empty()) return;
    if (!origin_) {  // the first cloud alone: its first point becomes the grids' common origin
      read(missing.front());
      missing.erase(missing.begin());
    }
    parallelFor(missing.size(), job_.threads, [&](std::size_t i) { read(missing[i]); });
  }

 private:
  void read(std::size_t cloud) {
    const DatasetCloud points = readPcd(job_.files[cloud]);
    if (points.points.empty()) throw InvalidProblem(job_.files[cloud] + ": cloud has no points");
    if (!origin_) origin_ = points.points.front();
    try {
      grids_[cloud] = std::make_unique<CellGrid>(points.points, *origin_, job_.distance);
    } catch (const InvalidProblem& error) {
      throw InvalidProblem(job_.files[cloud] + ": " + error.what());
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (events_.cloud_read) events_.cloud_read(cloud);
  }

  const OverlapJob& job_;
  const OverlapEvents& events_;
  std::mutex mutex_;
  std::optional<Eigen::Vector3d> origin_;
  std::vector<std::unique_ptr<CellGrid>> grids_;
};

std::vector<double> computeColumn(const OverlapJob& job, const HeldClouds& clouds,
                                  std::size_t target) {
  std::vector<double> column(job.files.size(), std::numeric_limits<double>::quiet_NaN());
  const Coverage coverage(clouds[target]);
  const Span sources = sourcesOf(job, target);
  for (std::size_t i = sources.first; i < sources.end; ++i) {
    column[i] = i == target ? 1.0 : shareOf(coverage.count(clouds[i]), clouds[i].size());
  }
  return column;
}

void requirePossible(const OverlapJob& job) {
  if (!std::is_sorted(job.targets.begin(), job.targets.end()) ||
      (!job.targets.empty() && job.targets.back() >= job.files.size())) {
    throw InvalidParameter(
        "overlap targets: found an impossible list, expected ascending "
        "positions of clouds");
  }
}

}  // namespace

double computeOverlap(const DatasetCloud& source, const DatasetCloud& target, double distance) {
  if (source.points.empty()) throw InvalidProblem("source cloud has no points");
  const CellGrid source_grid(source.points, source.points.front(), distance);
  const CellGrid target_grid(target.points, source.points.front(), distance);
  return shareOf(Coverage(target_grid).count(source_grid), source.points.size());
}

std::size_t countPairs(const OverlapJob& job) {
  std::size_t pairs = 0;
  for (const std::size_t target : job.targets) {
    const Span sources = sourcesOf(job, target);
    pairs += sources.end - sources.first - 1;
  }
  return pairs;
}

void computeOverlaps(const OverlapJob& job, const OverlapEvents& events) {
  requirePossible(job);
  HeldClouds clouds(job, events);
  std::mutex mutex;
  const std::size_t batch =
      job.window == 0 ? job.targets.size() : 4 * static_cast<std::size_t>(job.threads);
  for (std::size_t first = 0; first < job.targets.size(); first += batch) {
    const std::size_t end = std::min(first + batch, job.targets.size());
    clouds.hold(
        {sourcesOf(job, job.targets[first]).first, sourcesOf(job, job.targets[end - 1]).end});
    parallelFor(end - first, job.threads, [&](std::size_t i) {
      const std::size_t target = job.targets[first + i];
      const std::vector<double> column = computeColumn(job, clouds, target);
      const std::lock_guard<std::mutex> lock(mutex);
      if (events.column_done) events.column_done(target, column);
    });
  }
}

}  // namespace pcrb
