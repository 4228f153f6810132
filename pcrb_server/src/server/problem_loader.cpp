#include "server/problem_loader.hpp"

#include <utility>

namespace pcrb {

namespace {

constexpr std::size_t kAhead = 2;  // problems prepared before they are asked for

std::shared_ptr<const PointCloud> share(PointCloud cloud) {
  return std::make_shared<const PointCloud>(std::move(cloud));
}

std::shared_ptr<const PointCloud> cloudOf(const std::shared_ptr<const LoadedCloud>& loaded) {
  return {loaded, &loaded->cloud};
}

}  // namespace

ProblemLoader::ProblemLoader(const ServerParameters& parameters, const Secret& secret,
                             const std::vector<PlannedProblem>& problems)
    : parameters_(parameters),
      secret_(secret),
      problems_(problems),
      poser_(parameters.configuration.selection.root, parameters.configuration.presentation, secret,
             parameters.loading),
      allowed_(kAhead) {}

ProblemLoader::~ProblemLoader() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
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

PreparedProblem ProblemLoader::prepare(std::size_t position) {
  const ProblemFrames& frames = parameters_.frames;
  const PresentationOptions& options = parameters_.configuration.presentation;
  PreparedProblem prepared;
  static_cast<PosedProblem&>(prepared) = poser_.pose(problems_[position]);
  const Presentation& presentation = prepared.presentation;
  prepared.published_source =
      options.audit ? share(auditedSource(prepared, secret_)) : cloudOf(prepared.source);
  prepared.source_message = serializer_.serialize(*prepared.published_source, presentation.applied,
                                                  frames.source(options));
  prepared.publishes_target =
      position == 0 || problems_[position].target_path != problems_[position - 1].target_path;
  if (!prepared.publishes_target) return prepared;
  const auto target =
      options.audit ? share(auditedTarget(prepared, secret_)) : cloudOf(prepared.target);
  prepared.target_message = serializer_.serialize(*target, presentation.target_applied, frames.map);
  return prepared;
}

}  // namespace pcrb
