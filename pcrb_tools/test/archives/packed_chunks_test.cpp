#include <gtest/gtest.h>
#include <std_msgs/String.h>

#include <cstdint>
#include <functional>
#include <string>

#include "archives/bag_messages.hpp"
#include "pcrb_core/error.hpp"
#include "support/bag_packer.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using pcrb_test::behindLength;
using pcrb_test::bytesOf;
using pcrb_test::PackedChunk;

const std::string kFar(4, '\x7f');

/// Bags that somebody made on purpose, whose checksums are right.
class PackedChunks : public ::testing::TestWithParam<rosbag::CompressionType> {
 protected:
  PackedChunks() {
    rosbag::Bag bag(path_, rosbag::bagmode::Write);
    for (std::uint32_t i = 1; i <= 20; ++i) {
      std_msgs::String message;
      message.data = "a word";
      bag.write("/words", ros::Time(i, 0), message);
    }
  }

  PackedChunk pack(const std::string& bytes) const {
    return pcrb_test::packChunk(bytes, GetParam(), folder_.file("scratch"));
  }

  /// Reads a bag's words as a tool does.
  static int read(const std::string& path) {
    int words = 0;
    BagMessages({path}).forEach({"/words"}, [&](const rosbag::MessageInstance& message) {
      words += messageAs<std_msgs::String>(message)->data == "a word" ? 1 : 0;
    });
    return words;
  }

  int readWith(const std::function<PackedChunk(const std::string&)>& change) const {
    const std::string path = folder_.file("b.bag");
    pcrb_test::writeFile(path, pcrb_test::withChunks(path_, change));
    return read(path);
  }

  /// The bag's only chunk has other bytes behind the first message's `what`.
  int readWithBytes(const std::string& what, const std::string& bytes) const {
    return readWith([&](const std::string& chunk) {
      const std::size_t message = chunk.find("op=\2");
      return pack(chunk.substr(0, message) +
                  pcrb_test::withBytes(chunk.substr(message), what, bytes));
    });
  }

  pcrb_test::TemporaryFolder folder_;
  std::string path_ = folder_.file("a.bag");
};

TEST_P(PackedChunks, AreReadWhereNothingIsWrong) {
  EXPECT_EQ(readWith([&](const std::string& chunk) { return pack(chunk); }), 20);
}

TEST_P(PackedChunks, AMessageThatLeadsOutOfItsChunkIsRefused) {
  constexpr std::size_t kBeforeOp = 4 + 4 + 9 + 4;  // lengths of header and fields, connection
  const std::string time = "time=" + bytesOf(std::uint64_t{1});  // the header's last field
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readWithBytes(time, kFar), "cut or damaged");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readWithBytes("op=\2", kFar), "a header in pieces at byte");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readWith([&](std::string chunk) {
                      return pack(chunk.replace(chunk.find("op=\2") - kBeforeOp, 4, kFar));
                    }),
                    "found a header of 2139062143 bytes at byte");
}

/// rosbag takes what is behind a connection for a header, and the last one of fields with one name.
TEST_P(PackedChunks, AnythingButAMessageWhereTheIndexSaysOneIsRefused) {
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readWithBytes("op=", "\7"), "a record of another kind");
  const std::string fields = behindLength("op=\7") + behindLength("a=xxx");  // in place of the time
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readWithBytes("op=\2", fields), "a record of another kind");
}

TEST_P(PackedChunks, AMessageOfAnotherConnectionIsRefused) {
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readWithBytes("conn=", bytesOf(9U)),
                    "a message of another connection at byte");
}

TEST_P(PackedChunks, AChunkThatHoldsLessThanItSaysIsRefused) {
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readWith([&](const std::string& bytes) {
                      PackedChunk chunk = pack(bytes);
                      chunk.size += 100;
                      return chunk;
                    }),
                    "found a chunk");
}

TEST_P(PackedChunks, AnUnknownCompressionIsRefused) {
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, readWith([&](const std::string& bytes) {
                      PackedChunk chunk = pack(bytes);
                      chunk.compression = "zst";
                      return chunk;
                    }),
                    "a chunk that cannot be unpacked (a compression that is none of");
}

INSTANTIATE_TEST_SUITE_P(Compressions, PackedChunks,
                         ::testing::Values(rosbag::compression::Uncompressed,
                                           rosbag::compression::BZ2, rosbag::compression::LZ4));

/// roslz4 writes the block behind its buffer's end, before it looks at any checksum.
TEST(Lz4Chunk, ABlockThatIsLongerThanItsStreamSaysIsRefused) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.bag");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    std_msgs::String message;
    message.data = std::string(1000000, 'x');
    bag.write("/words", ros::Time(1, 0), message);
  }
  const std::string stream("\x04\x22\x4d\x18\x64\x40\xa7", 7);  // blocks of 64 KiB at most
  pcrb_test::writeFile(path, pcrb_test::withChunks(path, [&](const std::string& chunk) {
                         return PackedChunk{
                             "lz4", static_cast<std::uint32_t>(chunk.size()),
                             stream + bytesOf(static_cast<std::uint32_t>(chunk.size()) | 1U << 31) +
                                 chunk + std::string(8, '\0')};
                       }));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, BagMessages({path}),
                    "bytes, at most 65536 as its stream says");
}

}  // namespace
}  // namespace pcrb_tools
