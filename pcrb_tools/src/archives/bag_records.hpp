#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "pcrb_core/io/byte_order.hpp"

namespace pcrb_tools {

inline constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";

/// Kinds of a bag's records.
enum class BagRecordKind : char {
  kMessage = 2,
  kBagHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

/// A record's header, and where its data lies.
struct BagRecord {
  std::uint64_t position = 0;
  std::string header;  ///< fields `name=value`, each behind its length
  std::uint64_t data = 0;
  std::uint32_t size = 0;

  std::uint64_t end() const { return data + size; }
  BagRecordKind kind() const;
  /// A field of the header, the last of several as for rosbag; empty if there is none.
  std::string_view field(std::string_view name) const;
};

/// A little-endian number in the first bytes of a text that has them.
template <typename Number>
Number littleEndian(std::string_view bytes) {
  return static_cast<Number>(pcrb::loadUnsigned(bytes.data(), sizeof(Number)));
}

/// The records of a bag of ROS 1, by position; whatever they claim is checked against the file.
class BagRecords {
 public:
  explicit BagRecords(const std::string& path);

  /// Those of a packed chunk; what they claim is checked against what it holds.
  /// @throws InvalidFile  if it cannot be unpacked.
  BagRecords unpack(const BagRecord& chunk);

  std::uint64_t size() const { return size_; }

  /// Bytes of the file, until the next call; those after them are probably asked for next.
  std::string_view bytes(std::uint64_t position, std::size_t count);
  template <typename Number>
  Number number(std::uint64_t position) {
    return littleEndian<Number>(bytes(position, sizeof(Number)));
  }

  BagRecord at(std::uint64_t position);
  BagRecord at(std::uint64_t position, BagRecordKind kind);

  template <typename Number>
  Number numberOf(const BagRecord& record, std::string_view name) const {
    const std::string_view value = record.field(name);
    if (value.size() == sizeof(Number)) return littleEndian<Number>(value);
    refuse(record.position, "a record without " + std::string(name), "a bag's");
  }

  /// Makes sure that a text is made of fields, as a header is.
  void checkFields(std::uint64_t position, std::string_view header) const;

  [[noreturn]] void refuse(std::uint64_t position, const std::string& found,
                           const std::string& expected) const;
  [[noreturn]] void refuseCut(const std::string& why = "") const;

 private:
  BagRecords(const std::string& path, const BagRecord& chunk, std::string bytes);

  std::string path_;
  std::string what_ = "a bag";
  std::ifstream file_;
  std::uint64_t size_;
  std::string block_;
  std::uint64_t block_position_ = 0;
};

}  // namespace pcrb_tools
