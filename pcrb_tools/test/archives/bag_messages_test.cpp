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
  }
  pcrb_test::writeFile(cut, "<html>");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, requireWholeBag(cut), "expected a bag of ROS 1");
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
