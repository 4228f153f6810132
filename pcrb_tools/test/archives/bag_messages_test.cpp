#include "archives/bag_messages.hpp"

#include <gtest/gtest.h>
#include <std_msgs/String.h>

#include <filesystem>

#include "archives/bag_structure.hpp"
#include "pcrb_core/io/memory_budget.hpp"
#include "support/bag_packer.hpp"
#include "support/bag_writer.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

class BagMessagesTest : public ::testing::Test {
 protected:
  BagMessagesTest() {
    rosbag::Bag bag(path_, rosbag::bagmode::Write);
    for (std::uint32_t i = 1; i <= 20; ++i) {
      std_msgs::String message;
      message.data = std::string(1000, 'x');
      bag.write("/words", ros::Time(i, 0), message);
      bag.write("/more", ros::Time(i, 0), message);
    }
  }

  pcrb_test::TemporaryFolder folder_;
  std::string path_ = folder_.file("a.bag");
};

TEST_F(BagMessagesTest, DescribesTheTopicsWithTheirTypes) {
  EXPECT_EQ(BagMessages({path_}).describeTopics(),
            "the topics /more (std_msgs/String) /words (std_msgs/String)");
}

TEST_F(BagMessagesTest, AWholeBagIsWholeAndOneThatWasCutAnywhereIsNot) {
  requireWholeBag(path_);
  const std::string bytes = pcrb_test::readFile(path_);
  const std::string cut = folder_.file("cut.bag");
  for (const std::size_t size : {bytes.size() - 1, bytes.size() - 300, bytes.size() / 2,
                                 std::size_t{4200}, std::size_t{20}}) {
    pcrb_test::writeFile(cut, bytes.substr(0, size));
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, requireWholeBag(cut), "cut or damaged");
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, BagMessages({cut}), "cut or damaged");
  }
}

TEST_F(BagMessagesTest, WhatHasTheNameOfABagAndIsNoneIsNamed) {
  const auto expect = [&](const std::string& bytes, const char* what) {
    const std::string file = folder_.file("other.bag");
    pcrb_test::writeFile(file, bytes);
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, requireWholeBag(file), what);
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, BagMessages({file}), what);
  };
  expect("<html><body>Sign in</body></html>", "found an HTML page");
  expect("version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "found a Git LFS pointer");
  expect(std::string("SQLite format 3\0", 16) + std::string(100, 'x'), "a bag of ROS 2 (sqlite3)");
  expect("\x89MCAP0\r\n....", "a bag of ROS 2 (mcap)");
  expect("#ROSBAG V1.2\n", "found a bag of version 1");
  expect("\x1F\x8B\x08 a bag in gzip", "found a compressed archive");
  expect("", "found an empty file");
  expect("anything", "expected a bag of ROS 1");
}

TEST_F(BagMessagesTest, TheEndingsOfBagsThatCannotBeReadAreThoseOfBags) {
  for (const char* path : {"a.bag", "a.bag.active", "rosbag2/a_0.db3", "a.mcap"}) {
    EXPECT_TRUE(isBag(path)) << path;
  }
  EXPECT_FALSE(isBag("a.bag.zip"));
}

TEST_F(BagMessagesTest, ABagThatWasNotClosedIsNamed) {
  std::string bytes = pcrb_test::readFile(path_);
  const std::size_t field = bytes.find("index_pos=") + 10;
  bytes.replace(field, 8, 8, '\0');
  pcrb_test::writeFile(path_, bytes);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, requireWholeBag(path_), "a bag that was not closed");
}

TEST_F(BagMessagesTest, AChunkThatMemoryHasNoRoomForIsRefusedBeforeItIsUnpacked) {
  const std::string bomb = folder_.file("bomb.bag");
  for (const auto compression : {rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    rosbag::Bag bag(bomb, rosbag::bagmode::Write);
    bag.setCompression(compression);
    std_msgs::String zeros;
    zeros.data = std::string(4000000, '\0');
    bag.write("/words", ros::Time(1, 0), zeros);
    bag.close();
    auto& budget = pcrb::MemoryBudget::ofProcess();
    const std::size_t limit = budget.limit();
    budget.setLimit(7000000);
    PCRB_EXPECT_ERROR(
        pcrb::InvalidFile, BagMessages({bomb}),
        "a chunk that takes 9 MB of memory at byte 4117 of a bag, expected at most 7");
    budget.setLimit(9000000);
    EXPECT_EQ(BagMessages({bomb}).count({"/words"}), 1U);
    budget.setLimit(limit);
  }
}

TEST_F(BagMessagesTest, WhatRosbagWouldFollowOutOfTheFileIsRefused) {
  const std::string bytes = pcrb_test::readFile(path_);
  const std::string far(4, '\x7f');
  const auto expect = [&](const std::string& damaged, const char* error) {
    pcrb_test::writeFile(folder_.file("b.bag"), damaged);
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, BagMessages({folder_.file("b.bag")}), error);
  };
  expect(pcrb_test::withBytes(bytes, "chunk_pos=", far), "cut or damaged");
  expect(pcrb_test::withBytes(bytes, "chunk_pos=", std::string("\x0d\0\0\0", 4)),
         "a record of another kind");
  expect(pcrb_test::withBytes(bytes, "size=", far), "found a chunk of");
  const std::size_t index = bytes.find("op=\x04");  // of the records behind the chunk
  const std::size_t count = bytes.rfind("count=", index) + 6;
  expect(bytes.substr(0, count) + far + bytes.substr(count + 4), "in an index at byte");
  const std::size_t first = bytes.find("ver=", index) + 8 + 4 + 8;  // its first message's place
  expect(bytes.substr(0, first) + far + bytes.substr(first + 4), "a message behind the end");
}

TEST_F(BagMessagesTest, AListThatIsLongerThanItsMessageTakesNoMemory) {
  const std::string bag = folder_.file("clouds.bag");
  {
    const auto header = pcrb_test::headerAt(1, 0, "lidar");
    pcrb_test::BagWriter(bag).add("/cloud", pcrb_test::makeCloud(header, {1, 2, 3, 4, 5, 6}));
  }
  std::string bytes = pcrb_test::readFile(bag);
  const auto read = [&] {
    std::size_t points = 0;
    BagMessages({bag}).forEach({"/cloud"}, [&](const rosbag::MessageInstance& message) {
      points += messageAs<sensor_msgs::PointCloud2>(message)->width;
    });
    return points;
  };
  EXPECT_EQ(read(), 2U);
  const std::string fields("\x04\0\0\0\x03\0\0\0rgb", 11);  // so many, and the first one's name
  const std::string size("\x40\0\0\0\0\0\x80\x3f", 8);      // bytes of data, and the first float
  for (const std::string& list : {fields, size}) {
    std::string claim = bytes;
    claim.replace(claim.find(list), 4, "\xff\xff\xff\x7f");
    pcrb_test::writeFile(bag, claim);
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, read(), "damaged: Buffer Overrun");
  }
}

}  // namespace
}  // namespace pcrb_tools
