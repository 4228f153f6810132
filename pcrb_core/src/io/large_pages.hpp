#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>

namespace pcrb {

/// Asks for large pages for memory that is about to be filled: the first touch of each 4 kB can
/// take as long as what is then done with them. A system may not have them: nothing else changes.
inline void preferLargePages(void* memory, std::size_t bytes) noexcept {
  constexpr std::size_t kLargePage = 1 << 21;  // of x86-64, and mostly of arm64
  if (bytes < 2 * kLargePage) return;
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = (address + page - 1) / page * page;
  const std::uintptr_t end = (address + bytes) / page * page;
  madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace pcrb
