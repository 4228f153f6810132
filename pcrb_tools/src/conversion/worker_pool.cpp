#include "conversion/worker_pool.hpp"

#include <string>
#include <utility>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {

WorkerPool::WorkerPool(int threads, std::size_t max_waiting) : max_waiting_(max_waiting) {
  if (threads < 1 || max_waiting < 1) {
    throw pcrb::InvalidParameter("found " + std::to_string(threads) +
                                 " threads, expected at least 1");
  }
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    jobs_.clear();
  }
  work_.notify_all();
  for (auto& thread : threads_) thread.join();
}

void WorkerPool::submit(Job job) {
  std::unique_lock<std::mutex> lock(mutex_);
  room_.wait(lock, [this] { return jobs_.size() < max_waiting_ || failure_; });
  throwFailure();
  jobs_.push_back(std::move(job));
  work_.notify_one();
}

bool WorkerPool::trySubmit(Job& job) {
  const std::lock_guard<std::mutex> lock(mutex_);
  throwFailure();
  if (jobs_.size() >= max_waiting_) return false;
  jobs_.push_back(std::move(job));
  work_.notify_one();
  return true;
}

void WorkerPool::check() {
  const std::lock_guard<std::mutex> lock(mutex_);
  throwFailure();
}

void WorkerPool::finish() {
  std::unique_lock<std::mutex> lock(mutex_);
  room_.wait(lock, [this] { return jobs_.empty() && under_way_ == 0; });
  throwFailure();
}

void WorkerPool::throwFailure() {
  if (failure_) std::rethrow_exception(failure_);
}

void WorkerPool::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    work_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
    if (stop_) return;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    ++under_way_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      job();
    } catch (...) {
      failure = std::current_exception();
    }
    job = nullptr;  // its data go before the lock comes
    lock.lock();
    --under_way_;
    if (failure && !failure_) failure_ = failure;
    if (failure_) jobs_.clear();
    room_.notify_all();
  }
}

}  // namespace pcrb_tools
