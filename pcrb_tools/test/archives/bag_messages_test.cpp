#include "archives/bag_messages.hpp"

#include <gtest/gtest.h>
#include <std_msgs/String.h>

#include <filesystem>

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

}  // namespace
}  // namespace pcrb_tools
