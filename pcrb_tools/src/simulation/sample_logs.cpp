#include "simulation/sample_logs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "common/progress.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/parallel.hpp"
#include "simulation/noise.hpp"

namespace pcrb_tools::simulation {
namespace {

namespace fs = std::filesystem;

constexpr char kSettingsFile[] = "sample_logs.txt";
constexpr char kErrorsFile[] = "ground_truth_error.csv";

using Planner = LogPlan (*)(const LogOptions&);

const std::map<std::string, Planner>& planners() {
  static const std::map<std::string, Planner> by_data_set{{"eth", planEthLogs},
                                                          {"planetary", planPlanetaryLogs},
                                                          {"tum", planTumLogs},
                                                          {"kaist", planKaistLogs}};
  return by_data_set;
}

/// Claims the output folder: a new or empty one, or one with logs of the same settings; simulated
/// logs must not mix with real ones.
void claimFor(const SampleLogsRequest& request) {
  pcrb::claimFolder(request.output, kSettingsFile,
                    {"# Simulated by make_sample_logs: these logs are of no real sensor.",
                     "seed " + std::to_string(request.seed), "size " + request.size,
                     "ground_truth_error " + pcrb::formatShortest(request.ground_truth_error)},
                    pcrb::OtherFiles::kRefused);
}

std::string errorsText(const std::vector<KnownError>& errors) {
  std::string text = "data_set,sequence,cloud,x,y,z\n";
  for (const KnownError& known : errors) {
    text += known.data_set + "," + known.sequence + "," + known.cloud;
    for (int axis = 0; axis < 3; ++axis) {
      text += ",";
      pcrb::appendFixed(text, known.error[axis], 6);
    }
    text += "\n";
  }
  return text;
}

bool isComplete(const LogJob& job, const fs::path& output) {
  return std::all_of(job.files.begin(), job.files.end(),
                     [&output](const std::string& file) { return fs::exists(output / file); });
}

void append(LogPlan& all, LogPlan plan) {
  std::move(plan.jobs.begin(), plan.jobs.end(), std::back_inserter(all.jobs));
  std::move(plan.errors.begin(), plan.errors.end(), std::back_inserter(all.errors));
}

}  // namespace

using Eigen::Vector3d;

LazyScene lazyScene(SceneDescription (*describe)(std::uint64_t), std::uint64_t seed) {
  return std::async(std::launch::deferred, [describe, seed] { return Scene(describe(seed)); })
      .share();
}

PoseError::PoseError(std::uint64_t seed, double length) : length_(length) {
  pcrb::Random random = makeStream(seed, "ground truth error");
  azimuth_ = random.uniform(0.0, 6.28);
  elevation_ = random.uniform(0.0, 6.28);
}

Vector3d PoseError::at(double time) const {
  const double azimuth = azimuth_ + 1.3 * time;
  const double elevation = std::sin(elevation_ + 0.93 * time);
  return length_ * Vector3d(std::cos(elevation) * std::cos(azimuth),
                            std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
}

pcrb::Transform displaced(const pcrb::Transform& T_world_sensor, const Vector3d& error) {
  return Eigen::Translation3d(error) * T_world_sensor;
}

PathPoint followPath(const std::vector<Vector3d>& corners, double arc_length) {
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vector3d leg = corners[i + 1] - corners[i];
    if (arc_length <= leg.norm() || i + 2 == corners.size()) {
      const double share = std::clamp(arc_length / leg.norm(), 0.0, 1.0);
      return {corners[i] + share * leg, std::atan2(leg.y(), leg.x())};
    }
    arc_length -= leg.norm();
  }
  return {corners.front(), 0.0};
}

double pathLength(const std::vector<Vector3d>& corners) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    length += (corners[i + 1] - corners[i]).norm();
  return length;
}

double stopAt(int i, int count, const std::vector<Vector3d>& corners, double spacing) {
  return i * std::min(spacing, pathLength(corners) / std::max(1, count - 1));
}

void writeLogFile(const std::string& output, const std::string& file, const std::string& bytes) {
  const std::filesystem::path path = std::filesystem::path(output) / file;
  std::filesystem::create_directories(path.parent_path());
  pcrb::writeFileAtomically(path.string(), bytes);
}

LogSize logSize(const std::string& name) {
  if (name == "small") return {7, 120, 340, 8, 180, 120, 9, 2, 6, 10, 1800};
  if (name == "medium") return {20, 200, 600, 30, 270, 220, 30, 1, 6, 60, 1800};
  if (name == "large") return {45, 344, 1077, 110, 360, 280, 120, 1, 10, 300, 1800};
  throw pcrb::InvalidParameter("--size: found '" + name + "', expected small, medium or large");
}

void makeSampleLogs(const SampleLogsRequest& request) {
  const LogOptions options{request.seed, logSize(request.size), request.ground_truth_error,
                           request.threads};
  if (!std::isfinite(options.ground_truth_error) || options.ground_truth_error < 0.0) {
    throw pcrb::InvalidParameter("--ground-truth-error: expected a length in m of at least 0");
  }
  LogPlan plan;
  for (const std::string& data_set : request.data_sets) {
    const auto planner = planners().find(data_set);
    if (planner == planners().end()) {
      throw pcrb::InvalidParameter("--data-set: found '" + data_set +
                                   "', expected eth, planetary, tum or kaist");
    }
    append(plan, planner->second(options));
  }
  claimFor(request);
  if (options.ground_truth_error > 0.0) {
    writeLogFile(request.output, kErrorsFile, errorsText(plan.errors));
  }
  Progress progress("sample logs", "pieces", plan.jobs.size());
  pcrb::parallelFor(plan.jobs.size(), request.threads, [&](std::size_t i) {
    if (isComplete(plan.jobs[i], request.output)) {
      progress.keep(1);
      return;
    }
    plan.jobs[i].make(request.output);
    progress.add();
  });
  progress.finish();
}

}  // namespace pcrb_tools::simulation
