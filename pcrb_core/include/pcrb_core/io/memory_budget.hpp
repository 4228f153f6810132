#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>

namespace pcrb {

/// Memory that all threads together may take for what they read: a thread takes its share before
/// it allocates, and waits while others have it.
///
/// To wait for a share while holding one can last for ever: nobody does.
class MemoryBudget {
 public:
  /// Part of a budget, given back on destruction.
  class Share {
   public:
    Share() = default;
    Share(Share&& other) noexcept : budget_(other.budget_), bytes_(other.bytes_) {
      other.budget_ = nullptr;
    }
    Share& operator=(Share&& other) noexcept;
    ~Share() { release(); }

   private:
    friend class MemoryBudget;
    Share(MemoryBudget& budget, std::size_t bytes) : budget_(&budget), bytes_(bytes) {}
    void release();

    MemoryBudget* budget_ = nullptr;
    std::size_t bytes_ = 0;
  };

  explicit MemoryBudget(std::size_t bytes) : limit_(bytes) {}
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  /// The one that readers take from unless they are given another: a quarter of the machine's
  /// memory, or of what the process may take (ulimit -v) where that is less; see setLimit().
  static MemoryBudget& ofProcess();

  std::size_t limit() const;
  /// Shares that are there already stay.
  void setLimit(std::size_t bytes);

  /// Waits until so much is left.
  /// @throws InvalidParameter  if it is more than the limit: it says both.
  Share take(std::size_t bytes);

  /// Nothing instead of waiting.
  /// @throws InvalidParameter  as take().
  std::optional<Share> tryTake(std::size_t bytes);

 private:
  void requirePossible(std::size_t bytes) const;

  mutable std::mutex mutex_;
  std::condition_variable released_;
  std::size_t limit_;
  std::size_t taken_ = 0;
};

/// What to say of something that needs more memory than it may have.
struct MemoryExcess {
  std::string found;     ///< `a scan that takes 3001 MB of memory`
  std::string expected;  ///< `at most 1000 MB (--memory)`
};

/// @param what    e.g. `a scan`
/// @param needed  bytes, and those of the limit.
MemoryExcess describeExcess(const std::string& what, std::size_t needed, std::size_t limit);

}  // namespace pcrb
