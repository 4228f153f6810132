#include "conversion/kaist_stream.hpp"

#include <gtest/gtest.h>

#include "support/bag_writer.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

constexpr pcrb::Stamp kStart = 1519102894 * pcrb::kSecond;
constexpr int kScans = 120;  // 10 Hz

KaistFrames makeFrames() {
  std::vector<pcrb::StampedPose> poses;
  for (int i = 0; i <= 10 * kScans; ++i) {
    pcrb::Transform pose = pcrb::Transform::Identity();
    pose.translation().x() = 0.125 * i;
    poses.push_back({kStart + i * pcrb::kSecond / 100, pose});
  }
  return {pcrb::Transform::Identity(), pcrb::Transform::Identity(), pcrb::Trajectory(poses)};
}

/// The scan of one sensor, a point that only it has.
KaistStream::Message scanAt(pcrb::Stamp stamp, float side) {
  const auto header = pcrb_test::headerAt(static_cast<std::uint32_t>(stamp / pcrb::kSecond),
                                          static_cast<std::uint32_t>(stamp % pcrb::kSecond), "");
  const float seconds = static_cast<float>(stamp - kStart) / 1e9f;
  return boost::make_shared<sensor_msgs::PointCloud2>(
      pcrb_test::makeCloud(header, {seconds, side, 1.f}, {0, 32, 1, 0, "intensity"}));
}

class KaistPlaying : public testing::Test {
 protected:
  KaistPlaying() {
    request_.live = true;
    request_.max_waiting = 1000;
  }

  /// Plays parts of the log, one after the other: scans from, up to.
  ConversionReport play(const std::string& root, const std::vector<std::pair<int, int>>& parts) {
    request_.root = folder_.file(root);
    Conversion conversion(request_, "urban05", 0);
    KaistStream stream(frames_, request_, "urban05", "live ", conversion);
    for (const auto& [from, to] : parts) {
      for (int i = from; i != to; ++i) {
        // The right scan that is closest to a left one is the one before it.
        const pcrb::Stamp stamp = kStart + i * pcrb::kSecond / 10;
        stream.addLeft(scanAt(stamp + 30'000'000, 0.f));
        stream.addRight(scanAt(stamp + 90'000'000, 1.f));
      }
    }
    stream.finish();
    return conversion.finish();
  }

  std::map<std::string, std::string> clouds(const std::string& root) const {
    std::map<std::string, std::string> bytes;
    const std::string folder = folder_.file(root + "/kaist/urban05");
    for (const auto& name : pcrb_test::namesIn(folder)) {
      if (name != ".conversion") bytes[name] = pcrb_test::readFile(folder + '/' + name);
    }
    return bytes;
  }

  pcrb_test::TemporaryFolder folder_;
  const KaistFrames frames_ = makeFrames();
  KaistRequest request_;
};

TEST_F(KaistPlaying, OfALogFromItsMiddleAndThenWhollyMakesTheCloudsOfOnePlaying) {
  play("once", {{0, kScans}});
  const ConversionReport report = play("again", {{80, kScans}, {0, kScans}});
  EXPECT_EQ(report.written.size(), static_cast<std::size_t>(kScans));
  EXPECT_EQ(report.points.read, 2u * kScans);
  EXPECT_EQ(report.notes.size(), 1u);
  EXPECT_TRUE(clouds("again") == clouds("once"));
}

TEST_F(KaistPlaying, OfPartsThatWereCutShortMakesTheCloudsOfOnePlaying) {
  play("once", {{0, kScans}});
  const auto report = play("again", {{80, 100}, {60, 90}, {0, kScans}});
  EXPECT_EQ(report.dropped.size(), 1u);
  EXPECT_EQ(report.dropped.count("the stamp of an earlier one"), 1u);
  EXPECT_TRUE(clouds("again") == clouds("once"));
}

TEST_F(KaistPlaying, ThinnedToARateHasTheScansOfOnePlaying) {
  request_.max_rate = 2.0;
  play("once", {{0, kScans}});
  play("again", {{83, kScans}, {0, kScans}});
  auto again = clouds("again");
  for (const auto& [name, bytes] : clouds("once")) EXPECT_TRUE(again[name] == bytes) << name;
}

TEST_F(KaistPlaying, ScansThatAreRefusedTakeNoPlaceOfTheRate) {
  request_.max_rate = 2.0;
  request_.root = folder_.file("root");
  Conversion conversion(request_, "urban05", 0);
  KaistScanSelector selector(frames_, request_, "urban05", conversion);
  EXPECT_FALSE(selector.select(kStart - 20'000'000, kStart));  // before the first pose
  EXPECT_FALSE(selector.select(kStart + 80'000'000, std::nullopt));
  EXPECT_TRUE(selector.select(kStart + 180'000'000, kStart + 200'000'000));
  EXPECT_FALSE(selector.select(kStart + 280'000'000, kStart + 300'000'000));
}

}  // namespace
}  // namespace pcrb_tools
