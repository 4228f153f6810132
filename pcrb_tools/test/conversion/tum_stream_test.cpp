#include "conversion/tum_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

constexpr pcrb::Stamp kFirstStamp = 1311878220 * pcrb::kSecond;

/// 12 s of poses, 100 Hz.
pcrb::Trajectory makeTrajectory() {
  std::vector<pcrb::StampedPose> poses;
  for (int i = 0; i <= 1200; ++i) {
    poses.push_back({kFirstStamp + i * pcrb::kSecond / 100, pcrb::Transform::Identity()});
  }
  return pcrb::Trajectory(poses);
}

class TumScanSelectorAtTwoHertz : public testing::Test {
 protected:
  TumScanSelectorAtTwoHertz() {
    request_.root = folder_.path();
    conversion_.emplace(request_, "plain", 0);
    selector_.emplace(trajectory_, request_.options, 2.0, *conversion_);
  }

  static pcrb::Stamp stampOf(double seconds) {
    return kFirstStamp + static_cast<pcrb::Stamp>(seconds * 1e9);
  }

  bool selects(double seconds) { return selector_->select(stampOf(seconds)).has_value(); }

  /// Admitted images of a part of the log, by number; 30 Hz.
  std::set<int> play(int from, int to) {
    std::set<int> admitted;
    for (int i = from; i != to; ++i) {
      if (selects(i / 30.0)) admitted.insert(i);
    }
    return admitted;
  }

  ConversionReport report() {
    conversion_->wants("a.pcd", "");
    conversion_->add("a.pcd", [] {
      ConvertedScan scan;
      scan.cloud.points = {{1.0, 2.0, 3.0}};
      return scan;
    });
    return conversion_->finish();
  }

  pcrb_test::TemporaryFolder folder_;
  const pcrb::Trajectory trajectory_ = makeTrajectory();
  TumRequest request_;
  std::optional<Conversion> conversion_;
  std::optional<TumScanSelector> selector_;
};

TEST_F(TumScanSelectorAtTwoHertz,
       AdmitsTheImagesOfOnePlayingThoughTheLogWasPlayedFromItsMiddleBefore) {
  pcrb::RateLimiter once(2.0);
  std::set<int> expected;
  for (int i = 0; i != 360; ++i) {
    if (once.keep(stampOf(i / 30.0))) expected.insert(i);
  }
  std::set<int> admitted = play(251, 360);
  admitted.merge(play(0, 360));
  EXPECT_TRUE(std::includes(admitted.begin(), admitted.end(), expected.begin(), expected.end()));
  const ConversionReport text = report();
  ASSERT_EQ(text.notes.size(), 1u);
  EXPECT_NE(text.notes.front().find("the stamps went back"), std::string::npos);
}

TEST_F(TumScanSelectorAtTwoHertz, GivesNoPlaceToImagesWithoutAPose) {
  EXPECT_FALSE(selects(-0.1));
  EXPECT_TRUE(selects(0.1));
  EXPECT_FALSE(selects(0.2));
}

TEST_F(TumScanSelectorAtTwoHertz, DropsARepetitionAsOne) {
  EXPECT_TRUE(selects(0.0));
  EXPECT_FALSE(selects(0.0));
  EXPECT_FALSE(selects(0.1));
  const ConversionReport text = report();
  EXPECT_EQ(text.dropped.at("the stamp of an earlier one").size(), 1u);
  EXPECT_EQ(text.dropped.at("beyond the maximal rate").size(), 1u);
}

}  // namespace
}  // namespace pcrb_tools
