#include "pcrb_core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

TEST(Parallel, CallsEveryNumberOnce) {
  for (const int threads : {1, 2, 7}) {
    std::vector<std::atomic<int>> calls(1000);
    parallelFor(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) EXPECT_EQ(count, 1);
  }
  parallelFor(0, 3, [](std::size_t) { FAIL() << "nothing to do"; });
}

TEST(Parallel, OneThreadIsTheCallersAndKeepsTheOrder) {
  std::vector<std::size_t> order;
  const auto caller = std::this_thread::get_id();
  parallelFor(5, 1, [&](std::size_t i) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order.push_back(i);
  });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

TEST(Parallel, ErrorStopsTheWorkAndReachesTheCaller) {
  std::atomic<int> calls{0};
  const auto fail_at_ten = [&](std::size_t i) {
    ++calls;
    if (i == 10) throw InvalidProblem("ten");
  };
  EXPECT_THROW(parallelFor(1000000, 2, fail_at_ten), InvalidProblem);
  EXPECT_LT(calls, 1000000);
  EXPECT_THROW(parallelFor(1, 0, [](std::size_t) {}), InvalidParameter);
}

}  // namespace
}  // namespace pcrb
