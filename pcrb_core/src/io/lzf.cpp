#include "lzf.hpp"

#include <cstring>

namespace pcrb {

// A control byte below 32 announces that many literal bytes, plus one. Any other announces a copy
// from the output so far: three bits of length (7: another byte adds to it), thirteen of distance.
bool decodeLzf(std::string_view input, char* output, std::size_t size) {
  std::size_t in = 0;
  std::size_t out = 0;
  while (in < input.size()) {
    const auto control = static_cast<unsigned char>(input[in++]);
    if (control < 32) {
      const std::size_t length = control + std::size_t{1};
      if (length > input.size() - in || length > size - out) return false;
      std::memcpy(output + out, input.data() + in, length);
      in += length;
      out += length;
      continue;
    }
    std::size_t length = (control >> 5) + std::size_t{2};
    if (length == 9) {
      if (in == input.size()) return false;
      length += static_cast<unsigned char>(input[in++]);
    }
    if (in == input.size()) return false;
    const std::size_t distance =
        ((control & 31u) << 8) + static_cast<unsigned char>(input[in++]) + std::size_t{1};
    if (distance > out || length > size - out) return false;
    // Byte by byte: source and destination may overlap, which repeats a pattern.
    for (const std::size_t end = out + length; out < end; ++out)
      output[out] = output[out - distance];
  }
  return out == size;
}

}  // namespace pcrb
