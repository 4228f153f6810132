#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include "pcrb_core/parallel.hpp"

namespace pcrb {

/// Elements that one thread takes at a time: fixed, so that sums over blocks do not depend on the
/// thread count.
constexpr std::size_t kBlockSize = 256;

/// Calls body(begin, end) for blocks of kBlockSize elements that cover [0, count) once.
inline void forBlocks(std::size_t count, int threads,
                      const std::function<void(std::size_t, std::size_t)>& body) {
  parallelFor((count + kBlockSize - 1) / kBlockSize, threads, [&](std::size_t block) {
    body(block * kBlockSize, std::min(count, (block + 1) * kBlockSize));
  });
}

}  // namespace pcrb
