#include "pcrb_core/io/memory_budget.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>
#include <utility>
#include <vector>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"

namespace pcrb {
namespace {

TEST(MemoryBudget, GivesNoMoreThanThereIsAndTakesSharesBack) {
  MemoryBudget budget(100);
  MemoryBudget::Share first = budget.take(60);
  EXPECT_FALSE(budget.tryTake(41).has_value());
  EXPECT_TRUE(budget.tryTake(40).has_value());  // and back
  MemoryBudget::Share second = budget.take(40);
  first = std::move(second);  // the 60 are free
  EXPECT_FALSE(budget.tryTake(61).has_value());
  EXPECT_TRUE(budget.tryTake(60).has_value());
}

TEST(MemoryBudget, RefusesWhatItCouldNeverGive) {
  MemoryBudget budget(5000000);
  pcrb_test::expectError<InvalidParameter>(
      [&] { budget.take(7000000); }, "found something that takes 8 MB of memory", "at most 5 MB");
  EXPECT_THROW(budget.tryTake(5000001), InvalidParameter);
  budget.setLimit(7000000);
  budget.take(7000000);
}

TEST(MemoryBudget, LetsAThreadWaitForItsShareWhileOthersHaveIt) {
  MemoryBudget budget(3);
  std::atomic<int> at_once{0};
  std::atomic<int> most{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      for (int round = 0; round < 200; ++round) {
        const auto share = budget.take(1);
        const int now = ++at_once;
        for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
        }
        --at_once;
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_LE(most.load(), 3);
  EXPECT_TRUE(budget.tryTake(3).has_value());
}

TEST(MemoryBudget, OfTheProcessIsAtMostAQuarterOfTheMachines) {
  const auto machine = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
  EXPECT_GT(MemoryBudget::ofProcess().limit(), 10000000u);
  EXPECT_LE(MemoryBudget::ofProcess().limit(), machine / 4);
}

}  // namespace
}  // namespace pcrb
