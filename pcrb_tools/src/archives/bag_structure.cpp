#include "archives/bag_structure.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "archives/bag_records.hpp"
#include "common/process.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/foreign_data.hpp"
#include "pcrb_core/io/memory_budget.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

/// Where the index begins.
/// @throws InvalidFile  if there is none, or the bag is encrypted.
std::uint64_t indexPosition(const std::string& path, BagRecords& records) {
  const BagRecord header = records.at(kBagMagic.size(), BagRecordKind::kBagHeader);
  if (!header.field("encryptor").empty()) {
    throw pcrb::InvalidFile(path, 0, "an encrypted bag", "one that is not (rosbag decrypt)");
  }
  const auto index = records.numberOf<std::uint64_t>(header, "index_pos");
  if (index == 0) {
    throw pcrb::InvalidFile(path, 0, "a bag that was not closed",
                            "an index (rosbag reindex makes it; a bag.active is one whose "
                            "recording did not end)");
  }
  if (index <= records.size()) return index;
  records.refuseCut(": its index begins at " + std::to_string(index));
}

/// Where a chunk's messages lie: in the file, or in what was unpacked.
struct Messages {
  BagRecords& records;
  std::uint64_t begin;
  std::uint64_t end;
};

/// Looks at all that rosbag will believe.
class BagCheck {
 public:
  explicit BagCheck(const std::string& path)
      : records_(path), index_(indexPosition(path, records_)) {}

  void run();

 private:
  static constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 31;  // rosbag's buffers double

  void checkConnection(const BagRecord& connection);
  void checkChunk(const BagRecord& info);
  std::uint64_t memoryFor(const BagRecord& chunk) const;
  [[noreturn]] void refuseExcess(const BagRecord& record, const std::string& what,
                                 std::uint64_t needed, std::uint64_t limit) const;
  void countMessages(std::uint32_t messages, const BagRecord& index);
  void checkIndexes(const BagRecord& chunk, std::uint32_t indexes, Messages messages);
  void checkIndex(const BagRecord& index, Messages messages);
  void checkMessage(std::uint64_t place, std::uint32_t connection, Messages messages);

  BagRecords records_;
  std::uint64_t index_;
  std::uint64_t messages_ = 0;
  std::set<std::uint32_t> connections_;
  std::set<std::uint64_t> chunks_;  ///< positions
};

void BagCheck::run() {
  std::vector<BagRecord> chunks;
  for (std::uint64_t position = index_; position < records_.size();) {
    const BagRecord record = records_.at(position);
    if (record.kind() == BagRecordKind::kConnection) {
      checkConnection(record);
    } else if (record.kind() == BagRecordKind::kChunkInfo) {
      chunks.push_back(record);
    } else {
      records_.refuse(position, "a record of another kind", "the index's connections and chunks");
    }
    position = record.end();
  }
  for (const BagRecord& info : chunks) checkChunk(info);
}

void BagCheck::checkConnection(const BagRecord& connection) {
  constexpr std::uint32_t kLongest = 1 << 22;  // bytes: it has the message's definition
  if (connection.size > kLongest) {
    records_.refuse(connection.position,
                    "a connection of " + std::to_string(connection.size) + " bytes",
                    "at most " + std::to_string(kLongest));
  }
  records_.checkFields(connection.position, records_.bytes(connection.data, connection.size));
  connections_.insert(records_.numberOf<std::uint32_t>(connection, "conn"));
}

void BagCheck::checkChunk(const BagRecord& info) {
  constexpr std::uint32_t kEntry = 8;  // bytes: a connection, and its number of messages
  const auto indexes = records_.numberOf<std::uint32_t>(info, "count");
  if (info.size != std::uint64_t{kEntry} * indexes) {
    records_.refuse(info.position, std::to_string(info.size) + " bytes of a chunk's connections",
                    std::to_string(kEntry) + " for each of " + std::to_string(indexes));
  }
  const auto position = records_.numberOf<std::uint64_t>(info, "chunk_pos");
  if (!chunks_.insert(position).second) {
    records_.refuse(info.position, "a chunk for the second time", "every chunk once");
  }
  const BagRecord chunk = records_.at(position, BagRecordKind::kChunk);
  const std::uint64_t needed = memoryFor(chunk);
  if (chunk.field("compression") == "none") {
    checkIndexes(chunk, indexes, {records_, chunk.data, chunk.end()});
  } else if (indexes > 0) {
    const auto share = pcrb::MemoryBudget::ofProcess().take(needed);
    BagRecords unpacked = records_.unpack(chunk);
    checkIndexes(chunk, indexes, {unpacked, 0, unpacked.size()});
  }
}

void BagCheck::checkIndexes(const BagRecord& chunk, std::uint32_t indexes, Messages messages) {
  std::uint64_t next = chunk.end();
  for (std::uint32_t i = 0; i < indexes; ++i) {
    Interruption::check();
    const BagRecord index = records_.at(next, BagRecordKind::kIndex);
    checkIndex(index, messages);
    next = index.end();
  }
}

/// rosbag holds a chunk as it is in the file and unpacked, and then one of its messages.
std::uint64_t BagCheck::memoryFor(const BagRecord& chunk) const {
  const std::uint64_t unpacked = records_.numberOf<std::uint32_t>(chunk, "size");
  if (chunk.field("compression") == "none" && unpacked != chunk.size) {
    records_.refuse(chunk.position, "a chunk of " + std::to_string(chunk.size) + " bytes",
                    std::to_string(unpacked) + ", as it says");
  }
  const std::uint64_t needed = chunk.size + 2 * unpacked;
  const std::uint64_t limit = pcrb::MemoryBudget::ofProcess().limit();
  if (needed > limit || std::max<std::uint64_t>(chunk.size, unpacked) >= kLargestChunk) {
    refuseExcess(chunk, "a chunk", needed, std::min(limit, 2 * kLargestChunk));
  }
  return needed;
}

void BagCheck::refuseExcess(const BagRecord& record, const std::string& what, std::uint64_t needed,
                            std::uint64_t limit) const {
  const auto [found, expected] = pcrb::describeExcess(what, needed, limit);
  records_.refuse(record.position, found, expected);
}

/// rosbag holds the index as a tree.
void BagCheck::countMessages(std::uint32_t messages, const BagRecord& index) {
  constexpr std::uint64_t kNode = 64;  // bytes of a message's time and place
  messages_ += messages;
  const std::uint64_t limit = pcrb::MemoryBudget::ofProcess().limit();
  if (messages_ > limit / kNode) refuseExcess(index, "an index", messages_ * kNode, limit);
}

void BagCheck::checkIndex(const BagRecord& index, Messages messages) {
  constexpr std::uint32_t kEntry = 12;  // bytes: seconds, nanoseconds, place in the chunk
  const auto count = records_.numberOf<std::uint32_t>(index, "count");
  const auto connection = records_.numberOf<std::uint32_t>(index, "conn");
  if (index.size != std::uint64_t{kEntry} * count || connections_.count(connection) == 0) {
    records_.refuse(index.position,
                    std::to_string(index.size) + " bytes of connection " +
                        std::to_string(connection) + " in an index",
                    std::to_string(kEntry) + " for each of " + std::to_string(count) +
                        " messages, of a connection that is there");
  }
  countMessages(count, index);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t entry = index.data + std::uint64_t{kEntry} * i;
    checkMessage(records_.number<std::uint32_t>(entry + 8), connection, messages);
  }
}

void BagCheck::checkMessage(std::uint64_t place, std::uint32_t connection, Messages messages) {
  const std::uint64_t position = messages.begin + place;
  if (position >= messages.end) {
    messages.records.refuse(messages.begin, "a message behind the end of a chunk", "it inside");
  }
  const BagRecord message = messages.records.at(position, BagRecordKind::kMessage);
  if (message.end() > messages.end) {
    messages.records.refuse(position, "a message behind the end of a chunk", "it inside");
  }
  if (messages.records.numberOf<std::uint32_t>(message, "conn") != connection) {
    messages.records.refuse(position, "a message of another connection",
                            "one of " + std::to_string(connection) + ", as the index says");
  }
}

}  // namespace

void requireRos1Bag(const std::string& path) {
  constexpr std::size_t kEnough = 512;  // bytes
  const auto begin = pcrb::startOfFile(path, kEnough);
  if (!begin) throw pcrb::InvalidFile(path, 0, "nothing that can be read", "a bag of ROS 1");
  const std::string& start = *begin;
  pcrb::requireData(start, path);
  const auto begins = [&](std::string_view with) { return pcrb::startsWith(start, with); };
  if (begins(kBagMagic)) return;
  const char* const convert = "a bag of ROS 1 (rosbags-convert makes one of it)";
  if (begins("SQLite format 3"))
    throw pcrb::InvalidFile(path, 0, "a bag of ROS 2 (sqlite3)", convert);
  if (begins("\x89MCAP")) throw pcrb::InvalidFile(path, 0, "a bag of ROS 2 (mcap)", convert);
  if (begins("#ROSBAG V1")) {
    throw pcrb::InvalidFile(path, 0, "a bag of version 1", "version 2 (rosbag fix makes it)");
  }
  throw pcrb::InvalidFile(path, 0, start.empty() ? "an empty file" : "another beginning",
                          "a bag of ROS 1");
}

void requireWholeBag(const std::string& path) {
  requireRos1Bag(path);
  BagRecords records(path);
  std::uint64_t position = indexPosition(path, records);
  while (position < records.size()) position = records.at(position).end();
}

void requireReadableBag(const std::string& path) {
  requireRos1Bag(path);
  BagCheck(path).run();
}

}  // namespace pcrb_tools
