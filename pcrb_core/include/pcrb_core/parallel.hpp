#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace pcrb {

/// Calls body(0) … body(count − 1), each once, on several threads, lower numbers first.
///
/// The first exception that a call throws stops the handing out of numbers and is thrown to the
/// caller when the calls under way have ended. With one thread all happens on the caller's.
/// @throws InvalidParameter  if threads < 1.
void parallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

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

/// Number of processors that this process may use, at least 1.
int processorCount();

}  // namespace pcrb
