#include "conversion/worker_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

TEST(WorkerPool, DoesEveryJob) {
  std::atomic<int> sum{0};
  WorkerPool pool(3, 2);
  for (int i = 1; i <= 100; ++i) pool.submit([&sum, i] { sum += i; });
  pool.finish();
  EXPECT_EQ(sum, 5050);
}

TEST(WorkerPool, ThrowsWhatAJobHasThrownAndDropsTheRest) {
  std::atomic<int> done{0};
  WorkerPool pool(1, 1);
  pool.submit([] { throw pcrb::InvalidParameter("scan 3 is bad"); });
  EXPECT_THROW(
      {
        for (int i = 0; i < 10; ++i) pool.submit([&done] { ++done; });
        pool.finish();
      },
      pcrb::InvalidParameter);
  EXPECT_EQ(done, 0);
  EXPECT_THROW(pool.submit([] {}), pcrb::InvalidParameter);
}

TEST(WorkerPool, TellsOfAFailureToWhoeverAsks) {
  WorkerPool pool(1, 1);
  EXPECT_NO_THROW(pool.check());
  pool.submit([] { throw pcrb::InvalidParameter("scan 3 is bad"); });
  EXPECT_THROW(pool.finish(), pcrb::InvalidParameter);
  EXPECT_THROW(pool.check(), pcrb::InvalidParameter);
}

TEST(WorkerPool, TakesNoMoreJobsThanMayWait) {
  std::promise<void> gate;
  const std::shared_future<void> open = gate.get_future().share();
  std::promise<void> started;
  WorkerPool pool(1, 2);
  pool.submit([&started, open] {
    started.set_value();
    open.wait();
  });
  started.get_future().wait();
  WorkerPool::Job job = [] {};
  EXPECT_TRUE(pool.trySubmit(job));
  job = [] {};
  EXPECT_TRUE(pool.trySubmit(job));
  job = [] {};
  EXPECT_FALSE(pool.trySubmit(job));
  EXPECT_TRUE(job);
  gate.set_value();
  pool.finish();
}

TEST(WorkerPool, NeedsAThread) { EXPECT_THROW(WorkerPool(0, 1), pcrb::InvalidParameter); }

}  // namespace
}  // namespace pcrb_tools
