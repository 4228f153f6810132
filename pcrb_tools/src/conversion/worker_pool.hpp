#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pcrb_tools {

/// Threads that do jobs in the order of their coming, with a bounded queue before them.
class WorkerPool {
 public:
  using Job = std::function<void()>;

  /// @param threads      >= 1
  /// @param max_waiting  >= 1: jobs that may wait, with the data that they hold
  /// @throws InvalidParameter  for other numbers.
  WorkerPool(int threads, std::size_t max_waiting);

  /// Drops the jobs that wait and ends those under way.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Waits for room in the queue. Throws what an earlier job threw.
  void submit(Job job);

  /// Returns false instead of waiting. Throws what an earlier job threw.
  bool trySubmit(Job& job);

  /// Throws what a job threw, if one has.
  void check();

  /// Waits until all jobs are done. Throws what a job threw; the jobs after it were dropped.
  void finish();

 private:
  void work();
  void throwFailure();

  const std::size_t max_waiting_;
  std::mutex mutex_;
  std::condition_variable room_;
  std::condition_variable work_;
  std::deque<Job> jobs_;
  std::size_t under_way_ = 0;
  std::exception_ptr failure_;
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace pcrb_tools
