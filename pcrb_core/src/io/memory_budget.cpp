#include "pcrb_core/io/memory_budget.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

/// Bytes that this process may have.
std::size_t availableMemory() {
  const auto machine = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return machine;
  return std::min(machine, static_cast<std::size_t>(limit.rlim_cur));
}

}  // namespace

MemoryBudget::Share& MemoryBudget::Share::operator=(Share&& other) noexcept {
  if (this == &other) return *this;
  release();
  budget_ = other.budget_;
  bytes_ = other.bytes_;
  other.budget_ = nullptr;
  return *this;
}

void MemoryBudget::Share::release() {
  if (budget_ == nullptr) return;
  const std::lock_guard<std::mutex> lock(budget_->mutex_);
  budget_->taken_ -= bytes_;
  budget_->released_.notify_all();
  budget_ = nullptr;
}

MemoryBudget& MemoryBudget::ofProcess() {
  static MemoryBudget budget(availableMemory() / 4);
  return budget;
}

std::size_t MemoryBudget::limit() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return limit_;
}

void MemoryBudget::setLimit(std::size_t bytes) {
  const std::lock_guard<std::mutex> lock(mutex_);
  limit_ = bytes;
  released_.notify_all();
}

void MemoryBudget::requirePossible(std::size_t bytes) const {
  if (bytes <= limit_) return;
  const auto [found, expected] = describeExcess("something", bytes, limit_);
  throw InvalidParameter("found " + found + ", expected " + expected);
}

MemoryBudget::Share MemoryBudget::take(std::size_t bytes) {
  std::unique_lock<std::mutex> lock(mutex_);
  requirePossible(bytes);
  released_.wait(lock, [&] { return bytes > limit_ || taken_ <= limit_ - bytes; });
  requirePossible(bytes);  // the limit may have changed
  taken_ += bytes;
  return {*this, bytes};
}

std::optional<MemoryBudget::Share> MemoryBudget::tryTake(std::size_t bytes) {
  const std::lock_guard<std::mutex> lock(mutex_);
  requirePossible(bytes);
  if (taken_ > limit_ - bytes) return std::nullopt;
  taken_ += bytes;
  return Share(*this, bytes);
}

MemoryExcess describeExcess(const std::string& what, std::size_t needed, std::size_t limit) {
  constexpr std::size_t kMegabyte = 1000000;
  return {what + " that takes " + std::to_string(needed / kMegabyte + 1) + " MB of memory",
          "at most " + std::to_string(limit / kMegabyte) + " MB (--memory)"};
}

}  // namespace pcrb
