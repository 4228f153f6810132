#include <cstddef>
#include <cstdint>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/problem_file.hpp"

/// What is accepted can be written, and is then a fixed point.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const char* const begin = reinterpret_cast<const char*>(data);
  std::string text;
  try {
    text = pcrb::formatProblemFile(pcrb::parseProblemFile(begin, begin + size, "fuzz.txt"));
  } catch (const pcrb::InvalidFile&) {
    return 0;
  }
  const auto again = pcrb::parseProblemFile(text.data(), text.data() + text.size(), "again.txt");
  if (pcrb::formatProblemFile(again) != text) __builtin_trap();
  return 0;
}
