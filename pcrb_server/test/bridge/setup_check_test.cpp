#include "bridge/setup_check.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

constexpr const char* kCloud = "sensor_msgs/PointCloud2";

TopicGraph graphOfMcl() {
  TopicGraph graph;
  graph.types = {{"/cloud", kCloud},
                 {"/mapcloud", kCloud},
                 {"/filtered", kCloud},
                 {"/odom", "nav_msgs/Odometry"}};
  graph.subscribers = {
      {"/cloud", "/mcl"}, {"/mapcloud", "/mcl"}, {"/filtered", "/mcl"}, {"/odom", "/mcl"}};
  graph.publishers = {{"/filtered", "/filter"}};
  return graph;
}

TEST(DescribeUntaken, NamesTheTopicsThatNodesWaitOnAndWhatToType) {
  const std::string text = describeUntaken({{"scan_topic", "/scan", kCloud}}, graphOfMcl());
  EXPECT_EQ(text,
            "no node subscribes to /scan (scan_topic); nodes wait for sensor_msgs/PointCloud2 on "
            "/cloud (by /mcl), /mapcloud (by /mcl): set scan_topic:=/cloud or so\n"
            "pcrb probe finds out what a node takes; pcrb recipes lists the nodes that are known");
}

TEST(DescribeUntaken, SuggestsForAMapTheTopicThatIsCalledSo) {
  EXPECT_NE(describeUntaken({{"map_topic", "/map", kCloud}}, graphOfMcl())
                .find("set map_topic:=/mapcloud or so"),
            std::string::npos);
}

TEST(DescribeUntaken, SuggestsNothingWhereNoNodeWaitsForAnythingOfTheKind) {
  EXPECT_EQ(describeUntaken({{"imu_topic", "/imu", "sensor_msgs/Imu"}}, graphOfMcl()),
            "no node subscribes to /imu (imu_topic)");
  EXPECT_EQ(describeUntaken({}, graphOfMcl()), "");
}

TEST(DescribeWait, AsksForANodeWhereNoneWaitsForAnything) {
  const std::vector<RobotTopic> untaken{{"scan_topic", "/scan", kCloud}};
  EXPECT_EQ(describeWait("/scan", untaken, {}),
            "waiting for a node that subscribes to /scan; no node waits for such messages on "
            "another topic: has it started?");
  EXPECT_EQ(
      describeWait("/scan", untaken, graphOfMcl()),
      "waiting for a node that subscribes to /scan\n" + describeUntaken(untaken, graphOfMcl()));
}

TEST(HowToSet, TellsArgumentsFromEntriesOfTheFile) {
  EXPECT_EQ(howToSet("pose_topic", "/ndt_pose"), "pose_topic:=/ndt_pose");
  EXPECT_EQ(howToSet("answer_delay", "0.2"), "`answer_delay: 0.2` in bridge_parameters");
}

TEST(AdviceOnMounting, NamesTheFramesOfTf) {
  EXPECT_NE(
      adviceOnMounting("base_link", "velodyne", {"lidar", "map", "pcrb_target"})
          .find("on tf are lidar map: start what publishes the link, set `tf_base_scan: static`"),
      std::string::npos);
  EXPECT_EQ(adviceOnMounting("base_link", "velodyne", {}).find("nothing is on tf"), 0U);
}

}  // namespace
}  // namespace pcrb
