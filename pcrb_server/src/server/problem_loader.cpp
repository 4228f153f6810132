#include "server/problem_loader.hpp"

#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_hash.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/perturbation.hpp"

namespace pcrb {

namespace {

constexpr std::size_t kAhead = 2;  // problems prepared before they are asked for

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

}  // namespace

ProblemLoader::ProblemLoader(const ServerParameters& parameters, const Secret& secret,
                             const std::vector<PlannedProblem>& problems)
    : parameters_(parameters),
      secret_(secret),
      problems_(problems),
      cache_(parameters.cache_bytes),
      allowed_(kAhead) {}

ProblemLoader::~ProblemLoader() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

void ProblemLoader::checkFrames() {
  std::map<std::pair<std::string, Kind>, std::size_t> most_turned;
  for (std::size_t i = 0; i < problems_.size(); ++i) {
    const ProblemKey& key = problems_[i].key;
    std::size_t& chosen = most_turned.emplace(sequenceOf(key), i).first->second;
    if (turnOf(problems_[i]) > turnOf(problems_[chosen])) chosen = i;
  }
  for (const auto& [sequence, position] : most_turned) checkFramesOfSource(prepare(position));
}

void ProblemLoader::checkFramesOfSource(const PreparedProblem& loaded) {
  const Eigen::Vector3d centroid =
      loaded.source->metric->centroid() + loaded.source->cloud.local_origin;
  for (const auto& planned : problems_) {
    if (planned.source_path != loaded.planned->source_path) continue;
    naming(planned,
           [&] { checkFrame(planned.P, centroid, planned.data_set->bounds(planned.key.kind)); });
  }
}

PreparedProblem ProblemLoader::next() {
  if (!worker_.joinable()) worker_ = std::thread([this] { work(); });
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return !prepared_.empty(); });
  std::future<PreparedProblem> next = std::move(prepared_.front());
  prepared_.pop_front();
  return next.get();
}

void ProblemLoader::prepareAnother() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++allowed_;
  changed_.notify_all();
}

void ProblemLoader::work() {
  for (std::size_t i = 0; i < problems_.size(); ++i) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return is_over_ || i < allowed_; });
    if (is_over_) return;
    lock.unlock();
    std::packaged_task<PreparedProblem()> task([&] { return prepare(i); });
    task();
    lock.lock();
    prepared_.push_back(task.get_future());
    changed_.notify_all();
  }
}

std::shared_ptr<LoadedCloud> ProblemLoader::makeLoaded(const std::string& path,
                                                       const DatasetCloud& read,
                                                       const Eigen::Vector3d& local_origin) {
  auto loaded = std::make_shared<LoadedCloud>();
  loaded->name = std::filesystem::path(path).lexically_relative(parameters_.root);
  loaded->hash = fileHash(path);
  loaded->cloud = makeLocal(read, local_origin);
  loaded->has_viewpoint = read.hasViewpoint();
  loaded->viewpoint = read.viewpoint;
  loaded->viewpoint.translation() -= local_origin;
  cache_.insert(cacheKey(path, local_origin), loaded);
  return loaded;
}

std::shared_ptr<LoadedCloud> ProblemLoader::loadTarget(const std::string& path) {
  const auto origin = origins_.find(path);
  if (origin != origins_.end()) {
    if (auto loaded = cache_.find(cacheKey(path, origin->second))) return loaded;
  }
  const DatasetCloud cloud = readPcd(path, {parameters_.load_threads});
  origins_[path] = chooseLocalOrigin(cloud);
  return makeLoaded(path, cloud, origins_[path]);
}

std::shared_ptr<LoadedCloud> ProblemLoader::loadSource(const std::string& path,
                                                       const Eigen::Vector3d& local_origin) {
  auto loaded = cache_.find(cacheKey(path, local_origin));
  if (!loaded) {
    loaded = makeLoaded(path, readPcd(path, {parameters_.load_threads}), local_origin);
  }
  if (!loaded->metric) loaded->metric = std::make_shared<const Metric>(loaded->cloud);
  return loaded;
}

PreparedProblem ProblemLoader::prepare(std::size_t position) {
  PreparedProblem prepared;
  prepared.planned = &problems_[position];
  naming(*prepared.planned,
         [&] { pose(prepared, position == 0 ? "" : problems_[position - 1].target_path); });
  return prepared;
}

void ProblemLoader::pose(PreparedProblem& prepared, const std::string& previous_target) {
  const PlannedProblem& planned = *prepared.planned;
  const auto target = loadTarget(planned.target_path);
  const Eigen::Vector3d& origin = target->cloud.local_origin;
  const auto source = loadSource(planned.source_path, origin);
  const Eigen::Vector3d centroid = source->metric->centroid();
  checkFrame(planned.P, centroid + origin, planned.data_set->bounds(planned.key.kind));
  prepared.P = inLocalFrame(planned.P, origin);
  prepared.initial = source->metric->evaluate(prepared.P);
  if (parameters_.presentation == PresentationKind::kRegistration) {
    prepared.presentation = presentForRegistration(prepared.P);
  } else {
    const Transform V = secretSensorPose(secret_, planned.subject(), source->has_viewpoint,
                                         source->viewpoint, centroid, parameters_.upright);
    prepared.presentation = presentForLocalization(prepared.P, V);
  }
  prepared.source_message = serializer_.serialize(source->cloud, prepared.presentation.applied,
                                                  parameters_.sourceFrame());
  prepared.publishes_target = planned.target_path != previous_target;
  if (prepared.publishes_target) {
    prepared.target_message =
        serializer_.serialize(target->cloud, Transform::Identity(), parameters_.map_frame);
  }
  prepared.target = target;
  prepared.source = source;
}

}  // namespace pcrb
