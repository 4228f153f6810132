#include "bags/scene_bag.hpp"

#include <gtest/gtest.h>
#include <rosbag/view.h>

#include <filesystem>
#include <map>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

pcrb::Scene someScene(std::uint32_t second) {
  pcrb::Scene scene;
  scene.stamp = ros::Time(second, 0);
  scene.transforms.transforms.resize(1);
  scene.static_transforms.transforms.resize(2);
  scene.clouds.emplace_back(pcrb::topics::kScan, sensor_msgs::PointCloud2());
  scene.path.emplace();
  return scene;
}

class SceneBagTest : public ::testing::Test {
 protected:
  void write(const std::string& name, bool compress) const {
    SceneBag bag(folder_.file(name), compress);
    for (std::uint32_t second = 10; second < 13; ++second) bag.write(someScene(second));
    bag.commit();
  }

  pcrb_test::TemporaryFolder folder_;
};

TEST_F(SceneBagTest, LatchesWhatReplayLatches) {
  for (const bool compress : {false, true}) {
    write("a.bag", compress);
    const rosbag::Bag bag(folder_.file("a.bag"), rosbag::bagmode::Read);
    rosbag::View view(bag);
    EXPECT_EQ(view.size(), 12U);
    std::map<std::string, std::string> latching;
    for (const auto* connection : view.getConnections()) {
      latching[connection->topic] = connection->header->at("latching");
    }
    const std::map<std::string, std::string> expected{
        {"/pcrb/path", "1"}, {"/pcrb/scan", "1"}, {"/tf", "0"}, {"/tf_static", "1"}};
    EXPECT_EQ(latching, expected);
    EXPECT_EQ(view.getBeginTime(), ros::Time(10, 0));
    EXPECT_EQ(view.getEndTime(), ros::Time(12, 0));
  }
}

TEST_F(SceneBagTest, TheSameScenesAreTheSameBytes) {
  write("a.bag", false);
  write("b.bag", false);
  EXPECT_EQ(pcrb_test::readFile(folder_.file("a.bag")), pcrb_test::readFile(folder_.file("b.bag")));
}

TEST_F(SceneBagTest, AppearsCompleteOrNotAtAll) {
  {
    SceneBag bag(folder_.file("a.bag"), false);
    bag.write(someScene(10));
  }
  EXPECT_EQ(pcrb_test::namesIn(folder_.path()), std::vector<std::string>());
}

TEST_F(SceneBagTest, NamesTheBagThatCannotBeWritten) {
  pcrb_test::expectError<pcrb::InvalidFile>([&] { SceneBag(folder_.file("no/a.bag"), false); },
                                            "no/a.bag");
}

TEST_F(SceneBagTest, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  std::filesystem::create_symlink("/dev/full", folder_.file(".a.bag.tmp"));
  EXPECT_THROW(write("a.bag", false), pcrb::InvalidFile);
  EXPECT_FALSE(std::filesystem::exists(folder_.file("a.bag")));
}

}  // namespace
}  // namespace pcrb_tools
