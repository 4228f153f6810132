#pragma once

#include <cstddef>
#include <functional>

namespace pcrb {

/// Calls body(0) … body(count − 1), each once, on several threads, lower numbers first.
///
/// The first exception that a call throws stops the handing out of numbers and is thrown to the
/// caller when the calls under way have ended. With one thread all happens on the caller's.
/// @throws InvalidParameter  if threads < 1.
void parallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

/// Number of processors that this process may use, at least 1.
int processorCount();

}  // namespace pcrb
