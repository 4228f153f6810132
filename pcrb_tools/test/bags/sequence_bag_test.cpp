#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bags/bag_tools.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

class SequenceBag : public ::testing::Test {
 protected:
  SequenceBag() {
    options_.sequence.folder = folder_.file("own/yard");
    options_.bag.output = folder_.file("yard.bag");
    std::filesystem::create_directories(options_.sequence.folder);
    for (const char* name : {"1500000000.1", "1500000000.2", "1500000003.25"}) addScan(name);
  }

  void addScan(const std::string& name) {
    pcrb::DatasetCloud cloud;
    cloud.points = {{1, 2, 3}, {4, 5, 6}};
    pcrb::writePcd(options_.sequence.folder + "/" + name + ".pcd", cloud);
  }

  /// ms, of each scan from the bag's first one on.
  std::vector<std::int64_t> times() const {
    const rosbag::Bag bag(options_.bag.output, rosbag::bagmode::Read);
    std::vector<std::int64_t> times;
    for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/pcrb/scan"))) {
      times.push_back((message.getTime() - ros::Time(kBagStart, 0)).toNSec() / 1000000);
    }
    return times;
  }

  pcrb_test::TemporaryFolder folder_;
  SequenceBagOptions options_;
};

TEST_F(SequenceBag, PlaysAtARateOrAsTheSensorGaveTheScans) {
  runSequenceBagTool(options_);
  EXPECT_EQ(times(), (std::vector<std::int64_t>{0, 500, 1000}));
  options_.keeps_time = true;
  runSequenceBagTool(options_);
  EXPECT_EQ(times(), (std::vector<std::int64_t>{0, 100, 3150}));
}

TEST_F(SequenceBag, NeedsTimestampsInNamesToKeepTime) {
  options_.keeps_time = true;
  addScan("1500000003.250000000");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, runSequenceBagTool(options_), "is not later");
  std::filesystem::remove(options_.sequence.folder + "/1500000003.250000000.pcd");
  addScan("map");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, runSequenceBagTool(options_),
                    "map.pcd: found a name without a timestamp");
  options_.sequence.excluded = {"map.pcd"};
  runSequenceBagTool(options_);
  EXPECT_EQ(times().size(), 3u);
}

}  // namespace
}  // namespace pcrb_tools
