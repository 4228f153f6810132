#include "archives/bag_chunk.hpp"

#include <rosbag/exceptions.h>
#include <rosbag/stream.h>

#include <algorithm>
#include <cstdint>

#include "archives/bag_records.hpp"

namespace pcrb_tools {
namespace {

/// roslz4 copies a block as long as it says to be into a buffer of the size that the stream names.
void requireBlocksThatFit(std::string_view stream) {
  constexpr std::size_t kHeader = 7;  // bytes: magic number, flags, largest block, checksum
  constexpr std::size_t kLength = 4;  // bytes
  constexpr std::uint32_t kIsNotPacked = std::uint32_t{1} << 31;
  if (stream.size() < kHeader) throw rosbag::BagException("no stream of lz4");
  const std::size_t largest = std::size_t{1} << (8 + 2 * (stream[5] >> 4 & 7));
  stream.remove_prefix(kHeader);
  while (stream.size() >= kLength) {
    const std::size_t length = littleEndian<std::uint32_t>(stream) & ~kIsNotPacked;
    if (length == 0) return;
    if (length > largest) {
      throw rosbag::BagException("a block of " + std::to_string(length) + " bytes, at most " +
                                 std::to_string(largest) + " as its stream says");
    }
    stream.remove_prefix(std::min(kLength + length, stream.size()));
  }
}

/// Unpacks into all of `bytes`, of which the last one is another one before.
///
/// @return  whether it was written: bz2 does not say that there was less.
bool fills(std::string& bytes, char other, std::string_view packed, rosbag::Stream& stream) {
  bytes.back() = other;
  const auto address = [](const char* text) {  // rosbag has no const; it does not write a source
    return const_cast<std::uint8_t*>(reinterpret_cast<const std::uint8_t*>(text));
  };
  stream.decompress(address(bytes.data()), static_cast<unsigned>(bytes.size()),
                    address(packed.data()), static_cast<unsigned>(packed.size()));
  return bytes.back() != other;
}

std::string unpackWith(rosbag::Stream&& stream, std::string_view packed, std::size_t size) {
  std::string bytes(size, '\0');
  if (size == 0 || fills(bytes, '\xa5', packed, stream) || fills(bytes, '\x5a', packed, stream)) {
    return bytes;
  }
  throw rosbag::BagException("less than " + std::to_string(size) + " bytes, as it says");
}

}  // namespace

std::string unpackChunk(std::string_view compression, std::string_view packed, std::size_t size) {
  if (compression == "bz2") return unpackWith(rosbag::BZ2Stream(nullptr), packed, size);
  if (compression != "lz4") {
    throw rosbag::BagException("a compression that is none of none, bz2 and lz4");
  }
  requireBlocksThatFit(packed);
  return unpackWith(rosbag::LZ4Stream(nullptr), packed, size);
}

}  // namespace pcrb_tools
