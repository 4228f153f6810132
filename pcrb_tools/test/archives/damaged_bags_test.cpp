#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"
#include "scoring/recorded_poses.hpp"
#include "support/bag_packer.hpp"
#include "support/bag_writer.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

constexpr int kDamages = 400;
constexpr std::uint32_t kPoses = 60;

/// A bag of several chunks with the answers of a node.
std::string bagOfAnswers(const pcrb_test::TemporaryFolder& folder,
                         rosbag::CompressionType compression) {
  const std::string path = folder.file("answers.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.setCompression(compression);
  bag.setChunkThreshold(1000);
  for (std::uint32_t i = 1; i <= kPoses; ++i) {
    geometry_msgs::PoseStamped pose;
    pose.header = pcrb_test::headerAt(i, 0, "map");
    pose.pose.orientation.w = 1.0;
    bag.write("/pose", pose.header.stamp, pose);
  }
  bag.close();
  return pcrb_test::readFile(path);
}

/// Some bytes are others, or the end is missing.
std::string damagedBytes(std::string bytes, pcrb::Random& random) {
  if (random.uniform(0, 1) < 0.1) return bytes.substr(0, random.below(bytes.size()));
  for (std::uint64_t i = 0; i <= random.below(8); ++i) {
    bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
  }
  return bytes;
}

/// Whether a bag is read, as answers that could have been recorded; any other end is a failure.
bool isReadOrRefused(const std::string& path) {
  try {
    EXPECT_LE(readBagPoses(path, "/pose", "map").size(), kPoses);
    return true;
  } catch (const pcrb::Error&) {
    return false;
  }
}

class DamagedBags : public ::testing::TestWithParam<rosbag::CompressionType> {};

/// rosbag itself follows a damaged index to wherever it points.
TEST_P(DamagedBags, AreReadAsAnswersThatCouldHaveBeenRecordedOrRefused) {
  const pcrb_test::TemporaryFolder folder;
  const std::string whole = bagOfAnswers(folder, GetParam());
  pcrb::Random random(17);
  int read = 0;
  for (int i = 0; i < kDamages; ++i) {
    const std::string path = folder.file("damaged.bag");
    pcrb_test::writeFile(path, damagedBytes(whole, random));
    read += isReadOrRefused(path) ? 1 : 0;
  }
  EXPECT_GT(read, 0);  // damages of values, padding and definitions
  EXPECT_LT(read, kDamages);
}

/// Checksums say nothing about what was written on purpose.
TEST_P(DamagedBags, WhoseChecksumsAreRightAreReadOrRefusedToo) {
  const pcrb_test::TemporaryFolder folder;
  const std::string whole = folder.file("whole.bag");
  pcrb_test::writeFile(whole, bagOfAnswers(folder, rosbag::compression::Uncompressed));
  std::map<std::string, pcrb_test::PackedChunk> packed;  // of chunks that are not damaged
  pcrb::Random random(18);
  const auto change = [&](const std::string& chunk) {
    const auto pack = [&](const std::string& bytes) {
      return pcrb_test::packChunk(bytes, GetParam(), folder.file("scratch"));
    };
    if (random.uniform(0, 1) < 0.1) return pack(damagedBytes(chunk, random));
    if (packed.count(chunk) == 0) packed[chunk] = pack(chunk);
    return packed[chunk];
  };
  int read = 0;
  for (int i = 0; i < kDamages; ++i) {
    const std::string path = folder.file("damaged.bag");
    pcrb_test::writeFile(path, pcrb_test::withChunks(whole, change));
    read += isReadOrRefused(path) ? 1 : 0;
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, kDamages);
}

INSTANTIATE_TEST_SUITE_P(Compressions, DamagedBags,
                         ::testing::Values(rosbag::compression::Uncompressed,
                                           rosbag::compression::BZ2, rosbag::compression::LZ4));

}  // namespace
}  // namespace pcrb_tools
