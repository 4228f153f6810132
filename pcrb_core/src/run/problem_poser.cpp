#include "pcrb_core/run/problem_poser.hpp"

#include <filesystem>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/perturbation.hpp"

namespace pcrb {

namespace {

CloudCache::Key cacheKey(const std::string& path, const Eigen::Vector3d& origin) {
  return {path, {origin.x(), origin.y(), origin.z()}};
}

std::pair<std::string, Kind> sequenceOf(const ProblemKey& key) {
  return {key.data_set + "/" + key.sequence, key.kind};
}

double turnOf(const PlannedProblem& planned) { return rotationAngle(planned.P.linear()); }

/// Runs something that concerns a problem; its errors name the problem.
template <typename Body>
void naming(const PlannedProblem& planned, const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    throw InvalidProblem(sequenceOf(planned.key).first + ", problem " + planned.key.problem_id +
                         ": " + error.what());
  }
}

Presentation presentPlainly(const PosedProblem& posed, const PresentationOptions& options,
                            const Secret& secret) {
  if (!options.isLocalization()) return presentForRegistration(posed.P);
  const LoadedCloud& source = *posed.source;
  const Transform V =
      secretSensorPose(secret, posed.planned->subject(), source.has_viewpoint, source.viewpoint,
                       source.metric->centroid(), options.yaw_only);
  return presentForLocalization(posed.P, V);
}

}  // namespace

Presentation present(const PosedProblem& posed, const PresentationOptions& options,
                     const Secret& secret) {
  const Presentation plain = presentPlainly(posed, options, secret);
  if (!options.audit) return plain;
  const bool about_z = options.yaw_only || options.isLocalization();
  const Transform A = secretTargetMotion(secret, "audit " + posed.target->name,
                                         boxCenter(posed.target->cloud), about_z);
  return moved(plain, A, options.kind);
}

PointCloud auditedTarget(const PosedProblem& posed, const Secret& secret) {
  return secretPart(posed.target->cloud, secret, "target " + posed.target->name);
}

PointCloud auditedSource(const PosedProblem& posed, const Secret& secret) {
  return secretPart(posed.source->cloud, secret, "source " + posed.planned->subject());
}

ProblemPoser::ProblemPoser(std::string root, const PresentationOptions& presentation,
                           const Secret& secret, const LoadOptions& loading)
    : root_(std::move(root)),
      presentation_(presentation),
      secret_(secret),
      threads_(loading.threads),
      cache_(loading.cache_bytes) {}

void ProblemPoser::checkFrames(const std::vector<PlannedProblem>& problems) {
  std::map<std::pair<std::string, Kind>, std::size_t> most_turned;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const ProblemKey& key = problems[i].key;
    std::size_t& chosen = most_turned.emplace(sequenceOf(key), i).first->second;
    if (turnOf(problems[i]) > turnOf(problems[chosen])) chosen = i;
  }
  for (const auto& [sequence, position] : most_turned) {
    const PosedProblem posed = pose(problems[position]);
    const Eigen::Vector3d centroid =
        posed.source->metric->centroid() + posed.source->cloud.local_origin;
    for (const auto& planned : problems) {
      if (planned.source_path != posed.planned->source_path) continue;
      naming(planned,
             [&] { checkFrame(planned.P, centroid, planned.data_set->bounds(planned.key.kind)); });
    }
  }
}

std::shared_ptr<LoadedCloud> ProblemPoser::makeLoaded(const std::string& path,
                                                      const DatasetCloud& read,
                                                      const Eigen::Vector3d& local_origin) {
  if (!read.points.empty()) origins_.emplace(path, chooseLocalOrigin(read));  // a target, or later
  auto loaded = std::make_shared<LoadedCloud>();
  loaded->name = std::filesystem::path(path).lexically_relative(root_);
  loaded->hash = fileHash(path);
  loaded->cloud = makeLocal(read, local_origin);
  loaded->has_viewpoint = read.hasViewpoint();
  loaded->viewpoint = read.viewpoint;
  loaded->viewpoint.translation() -= local_origin;
  cache_.insert(cacheKey(path, local_origin), loaded);
  return loaded;
}

std::shared_ptr<LoadedCloud> ProblemPoser::loadTarget(const std::string& path) {
  const auto origin = origins_.find(path);
  if (origin != origins_.end()) {
    if (auto loaded = cache_.find(cacheKey(path, origin->second))) return loaded;
  }
  const DatasetCloud cloud = readPcd(path, {threads_});
  return makeLoaded(path, cloud, chooseLocalOrigin(cloud));
}

std::shared_ptr<LoadedCloud> ProblemPoser::loadSource(const std::string& path,
                                                      const Eigen::Vector3d& local_origin) {
  auto loaded = cache_.find(cacheKey(path, local_origin));
  if (!loaded) {
    loaded = makeLoaded(path, readPcd(path, {threads_}), local_origin);
  }
  if (!loaded->metric) loaded->metric = std::make_shared<const Metric>(loaded->cloud);
  return loaded;
}

PosedProblem ProblemPoser::pose(const PlannedProblem& planned) {
  PosedProblem posed;
  naming(planned, [&] { posed = load(planned); });
  return posed;
}

PosedProblem ProblemPoser::load(const PlannedProblem& planned) {
  PosedProblem posed;
  posed.planned = &planned;
  const auto target = loadTarget(planned.target_path);
  const Eigen::Vector3d& origin = target->cloud.local_origin;
  const auto source = loadSource(planned.source_path, origin);
  const Eigen::Vector3d centroid = source->metric->centroid();
  checkFrame(planned.P, centroid + origin, planned.data_set->bounds(planned.key.kind));
  posed.P = inLocalFrame(planned.P, origin);
  posed.initial = source->metric->evaluate(posed.P);
  posed.target = target;
  posed.source = source;
  posed.presentation = present(posed, presentation_, secret_);
  return posed;
}

}  // namespace pcrb
