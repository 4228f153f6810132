#include "ros/topic_peers.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

using Lines = std::vector<std::string>;

class ConflictingPublishersTest : public testing::Test {
 protected:
  ConflictingPublishers conflicts_{
      "/pcrb/bridge", {"/map", "/scan"}, "/initialpose", [](const std::string& node) {
        return node == "/rviz";
      }};
};

TEST_F(ConflictingPublishersTest, NamesEachNodeWithItsTopic) {
  EXPECT_EQ(conflicts_.find({{"/map", "/map_server"}, {"/scan", "/driver"}}),
            (Lines{"/map_server publishes /map", "/driver publishes /scan"}));
}

TEST_F(ConflictingPublishersTest, AllowsThisNodeAndOtherTopics) {
  EXPECT_EQ(conflicts_.find({{"/map", "/pcrb/bridge"}, {"/odom", "/driver"}}), Lines());
}

TEST_F(ConflictingPublishersTest, AllowsAnObserverToAdvertiseTheInitialPoseButNotTheMap) {
  EXPECT_EQ(conflicts_.find({{"/initialpose", "/rviz"}, {"/map", "/rviz"}}),
            (Lines{"/rviz publishes /map"}));
}

TEST_F(ConflictingPublishersTest, RefusesAnotherInitialPoseBeforeTheRunAndWarnsOfItOnceInTheRun) {
  const PublishersByTopic publishers{{"/initialpose", "/operator"}};
  EXPECT_EQ(conflicts_.find(publishers), (Lines{"/operator publishes /initialpose"}));
  conflicts_.beginRun();
  testing::internal::CaptureStdout();
  EXPECT_EQ(conflicts_.find(publishers), Lines());
  EXPECT_EQ(conflicts_.find(publishers), Lines());
  const std::string told = testing::internal::GetCapturedStdout();
  EXPECT_EQ(told.substr(told.find("] ") + 2),  // behind the name of this node
            "warning: /operator advertises /initialpose: a pose from it would spoil the problem in "
            "flight\n");
}

TEST(SubscriberNames, KnowsObserversByTheBeginningOfTheirNames) {
  const SubscriberNames names({"rviz", "rqt"});
  EXPECT_TRUE(names.isObserver("/rviz_1234_5678"));
  EXPECT_TRUE(names.isObserver("/tools/rqt_plot"));
  EXPECT_FALSE(names.isObserver("/rviz/localizer"));
  EXPECT_FALSE(names.isObserver("/ndt_rviz"));
}

TEST(SubscriberNames, KnowsRosbagsNodesByTheTimeInTheirNames) {
  const SubscriberNames names(std::vector<std::string>{});
  EXPECT_TRUE(names.isObserver("/record_1700000000"));
  EXPECT_TRUE(names.isObserver("/play_17"));
  EXPECT_FALSE(names.isObserver("/record_"));
  EXPECT_FALSE(names.isObserver("/play_localizer"));
}

}  // namespace
}  // namespace pcrb
