#include "archives/bag_records.hpp"

#include <rosbag/exceptions.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "archives/bag_chunk.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kBlock = 4096;
constexpr std::uint32_t kLongestHeader = 1 << 16;

}  // namespace

BagRecordKind BagRecord::kind() const {
  const std::string_view value = field("op");
  return static_cast<BagRecordKind>(value.size() == 1 ? value.front() : '\0');
}

std::string_view BagRecord::field(std::string_view name) const {
  std::string_view value;
  for (std::string_view rest = header; !rest.empty();) {
    const std::string_view entry = rest.substr(4, littleEndian<std::uint32_t>(rest));
    if (entry.substr(0, name.size()) == name && entry.substr(name.size(), 1) == "=") {
      value = entry.substr(name.size() + 1);
    }
    rest.remove_prefix(4 + entry.size());
  }
  return value;
}

BagRecords::BagRecords(const std::string& path)
    : path_(path), file_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {}

BagRecords::BagRecords(const std::string& path, const BagRecord& chunk, std::string bytes)
    : path_(path),
      what_("the chunk at byte " + std::to_string(chunk.position)),
      size_(bytes.size()),
      block_(std::move(bytes)) {}

BagRecords BagRecords::unpack(const BagRecord& chunk) {
  try {
    const auto size = numberOf<std::uint32_t>(chunk, "size");
    return {path_, chunk,
            unpackChunk(chunk.field("compression"), bytes(chunk.data, chunk.size), size)};
  } catch (const rosbag::BagException& error) {
    refuse(chunk.position, "a chunk that cannot be unpacked (" + std::string(error.what()) + ")",
           "what rosbag packs");
  }
}

void BagRecords::refuse(std::uint64_t position, const std::string& found,
                        const std::string& expected) const {
  throw pcrb::InvalidFile(path_, 0, found + " at byte " + std::to_string(position) + " of " + what_,
                          expected);
}

void BagRecords::refuseCut(const std::string& why) const {
  throw pcrb::InvalidFile(path_, 0,
                          std::to_string(size_) + " bytes of " + what_ + " that is cut or damaged",
                          "all of it" + why);
}

std::string_view BagRecords::bytes(std::uint64_t position, std::size_t count) {
  if (position > size_ || count > size_ - position) refuseCut();
  const std::uint64_t end = block_position_ + block_.size();
  if (position < block_position_ || position > end || count > end - position) {
    block_.resize(std::max(count, kBlock));
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(position));
    file_.read(block_.data(), static_cast<std::streamsize>(block_.size()));
    block_.resize(static_cast<std::size_t>(file_.gcount()));
    block_position_ = position;
    if (block_.size() < count) refuseCut();
  }
  return std::string_view(block_).substr(position - block_position_, count);
}

BagRecord BagRecords::at(std::uint64_t position) {
  BagRecord record;
  record.position = position;
  const auto header_size = number<std::uint32_t>(position);
  if (header_size > kLongestHeader) {
    refuse(position, "a header of " + std::to_string(header_size) + " bytes", "a record's");
  }
  record.header = bytes(position + 4, header_size);
  checkFields(position, record.header);
  record.size = number<std::uint32_t>(position + 4 + header_size);
  record.data = position + 8 + header_size;
  if (record.end() > size_) refuseCut();
  return record;
}

BagRecord BagRecords::at(std::uint64_t position, BagRecordKind kind) {
  BagRecord record = at(position);
  if (record.kind() == kind) return record;
  refuse(position, "a record of another kind", "kind " + std::to_string(static_cast<int>(kind)));
}

void BagRecords::checkFields(std::uint64_t position, std::string_view header) const {
  while (!header.empty()) {
    const std::uint32_t size = header.size() < 4 ? 0 : littleEndian<std::uint32_t>(header);
    if (size == 0 || size > header.size() - 4) {
      refuse(position, "a header in pieces", "fields behind their lengths");
    }
    header.remove_prefix(4 + size);
  }
}

}  // namespace pcrb_tools
