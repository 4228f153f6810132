#pragma once

#include <rosbag/chunked_file.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "archives/bag_records.hpp"
#include "support/log_folder.hpp"

namespace pcrb_test {

/// A number's bytes, as bags have them.
template <typename Number>
std::string bytesOf(Number number) {
  return std::string(reinterpret_cast<const char*>(&number), sizeof(number));
}

/// Bytes behind their length, as bags have them.
inline std::string behindLength(const std::string& bytes) {
  return bytesOf(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

/// The text with other bytes behind the first of some.
inline std::string withBytes(std::string text, const std::string& what, const std::string& bytes) {
  text.replace(text.find(what) + what.size(), bytes.size(), bytes);
  return text;
}

/// A chunk of a bag.
struct PackedChunk {
  std::string compression;
  std::uint32_t size;  ///< that it says to hold, bytes
  std::string bytes;
};

/// Bytes in a chunk as rosbag packs them, with the right checksum.
inline PackedChunk packChunk(const std::string& bytes, rosbag::CompressionType compression,
                             const std::string& scratch_file) {
  rosbag::ChunkedFile file;
  file.openWrite(scratch_file);
  file.setWriteMode(compression);
  file.write(bytes);
  file.setWriteMode(rosbag::compression::Uncompressed);
  file.close();
  const char* const names[] = {"none", "bz2", "lz4"};  // as the enumeration has them
  return {names[compression], static_cast<std::uint32_t>(bytes.size()), readFile(scratch_file)};
}

/// The bytes of a bag like another, whose chunks are not packed, but for these.
inline std::string withChunks(const std::string& path,
                              const std::function<PackedChunk(const std::string&)>& change) {
  using pcrb_tools::BagRecordKind;
  pcrb_tools::BagRecords records(path);
  std::string bag(pcrb_tools::kBagMagic);
  std::map<std::uint64_t, std::uint64_t> places;  // of the other bag's records
  for (std::uint64_t at = bag.size(); at < records.size();) {
    const pcrb_tools::BagRecord record = records.at(at);
    places[at] = bag.size();
    std::string data(records.bytes(record.data, record.size));
    std::string header = record.header;
    if (record.kind() == BagRecordKind::kChunk) {
      const PackedChunk chunk = change(data);
      header = behindLength("op=\5") + behindLength("compression=" + chunk.compression) +
               behindLength("size=" + bytesOf(chunk.size));
      data = chunk.bytes;
    } else if (record.kind() == BagRecordKind::kChunkInfo) {
      const auto place = places.at(records.numberOf<std::uint64_t>(record, "chunk_pos"));
      header = withBytes(header, "chunk_pos=", bytesOf(place));
    }
    bag += behindLength(header) + behindLength(data);
    at = record.end();
  }
  const auto index = records.numberOf<std::uint64_t>(
      records.at(pcrb_tools::kBagMagic.size(), BagRecordKind::kBagHeader), "index_pos");
  return withBytes(bag, "index_pos=", bytesOf(places.at(index)));
}

}  // namespace pcrb_test
