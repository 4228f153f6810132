#include "server/problem_loader.hpp"

namespace pcrb {

namespace {

constexpr std::size_t kAhead = 2;  // problems prepared before they are asked for

}  // namespace

ProblemLoader::ProblemLoader(const ServerParameters& parameters, const Secret& secret,
                             const std::vector<PlannedProblem>& problems)
    : parameters_(parameters),
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
  PreparedProblem prepared;
  static_cast<PosedProblem&>(prepared) = poser_.pose(problems_[position]);
  prepared.source_message =
      serializer_.serialize(prepared.source->cloud, prepared.presentation.applied,
                            parameters_.frames.source(parameters_.configuration.presentation));
  prepared.publishes_target =
      position == 0 || problems_[position].target_path != problems_[position - 1].target_path;
  if (prepared.publishes_target) {
    prepared.target_message = serializer_.serialize(prepared.target->cloud, Transform::Identity(),
                                                    parameters_.frames.map);
  }
  return prepared;
}

}  // namespace pcrb
