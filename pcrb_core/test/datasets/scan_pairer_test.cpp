#include "pcrb_core/datasets/scan_pairer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

using Pairer = ScanPairer<int>;
constexpr Stamp kPatience = 1000;

/// `left>right`, or `left>-`.
std::vector<std::string> textOf(const std::vector<Pairer::Pair>& pairs) {
  std::vector<std::string> texts;
  for (const auto& pair : pairs) {
    texts.push_back(std::to_string(pair.left_stamp) + '>' +
                    (pair.right ? std::to_string(pair.right->first) : "-"));
  }
  return texts;
}

using Texts = std::vector<std::string>;

TEST(ScanPairer, GivesAPairOnceNoCloserScanCanCome) {
  Pairer pairer(kPatience);
  EXPECT_EQ(textOf(pairer.addRight(90, 0)), Texts{});
  EXPECT_EQ(textOf(pairer.addLeft(100, 0)), Texts{});
  EXPECT_EQ(textOf(pairer.addRight(105, 0)), Texts{"100>105"});
  EXPECT_EQ(textOf(pairer.addLeft(104, 0)), Texts{"104>105"});
}

TEST(ScanPairer, PrefersTheEarlierOfTwoAtTheSameDistance) {
  Pairer pairer(kPatience);
  pairer.addRight(90, 0);
  pairer.addLeft(100, 0);
  EXPECT_EQ(textOf(pairer.addRight(110, 0)), Texts{"100>90"});
}

TEST(ScanPairer, WaitsNoLongerThanItsPatienceAndFlushesAtTheEnd) {
  Pairer pairer(kPatience);
  pairer.addLeft(100, 0);
  EXPECT_EQ(textOf(pairer.addLeft(1100, 0)), Texts{});
  EXPECT_EQ(textOf(pairer.addLeft(1101, 0)), Texts{"100>-"});
  EXPECT_EQ(textOf(pairer.flush()), (Texts{"1100>-", "1101>-"}));
}

TEST(ScanPairer, ForgetsWhatNoLaterScanNeeds) {
  Pairer pairer(kPatience);
  for (Stamp stamp = 0; stamp < 1000000; stamp += 100) {
    pairer.addLeft(stamp, 0);
    pairer.addRight(stamp + 40, 0);
    ASSERT_LE(pairer.waiting(), 4u);
  }
  Pairer one_sided(kPatience);
  for (Stamp stamp = 0; stamp < 1000000; stamp += 100) one_sided.addRight(stamp, 0);
  EXPECT_LE(one_sided.waiting(), 12u);
}

TEST(ScanPairer, PairsALogThatIsPlayedAgainAsIfNothingHadComeBefore) {
  Pairer pairer(5 * kSecond);
  for (Stamp second = 8; second <= 12; ++second) {
    pairer.addLeft(second * kSecond, 0);
    pairer.addRight(second * kSecond + 40, 0);
  }
  for (Stamp second = 0; second <= 12; ++second) {
    EXPECT_EQ(textOf(pairer.addLeft(second * kSecond, 0)), Texts{}) << second;
    EXPECT_EQ(
        textOf(pairer.addRight(second * kSecond + 40, 0)),
        Texts{std::to_string(second * kSecond) + '>' + std::to_string(second * kSecond + 40)});
  }
}

TEST(ScanPairer, GivesWhatWaitsWithItsBestPartnerWhenAStreamGoesBack) {
  Pairer pairer(5 * kSecond);
  pairer.addRight(8 * kSecond, 0);
  pairer.addLeft(8 * kSecond + 70, 0);
  EXPECT_EQ(textOf(pairer.addLeft(0, 0)), Texts{"8000000070>8000000000"});
  EXPECT_EQ(textOf(pairer.addRight(90, 0)), Texts{"0>90"});
}

TEST(ScanPairer, DoesNotPairWhatOneStreamStillSendsFromBeforeTheOtherWentBack) {
  Pairer pairer(5 * kSecond);
  pairer.addLeft(12 * kSecond, 0);
  pairer.addRight(12 * kSecond, 0);
  EXPECT_EQ(textOf(pairer.addLeft(0, 0)), Texts{});
  EXPECT_EQ(textOf(pairer.addRight(12 * kSecond + 90, 0)), Texts{});
  EXPECT_EQ(textOf(pairer.addRight(40, 0)), Texts{"0>40"});
}

TEST(ScanPairer, GivesALeftScanFromBeforeTheRightStreamWentBackWithoutAPartner) {
  Pairer pairer(5 * kSecond);
  pairer.addLeft(12 * kSecond, 0);
  pairer.addRight(12 * kSecond, 0);
  EXPECT_EQ(textOf(pairer.addRight(0, 0)), Texts{});
  EXPECT_EQ(textOf(pairer.addLeft(12 * kSecond + 90, 0)), Texts{"12000000090>-"});
  EXPECT_EQ(textOf(pairer.addLeft(0, 0)), Texts{"0>0"});
}

TEST(ScanPairer, TakesDisorderWithinASecondForNoGoingBack) {
  Pairer pairer(5 * kSecond);
  pairer.addRight(8 * kSecond, 0);
  pairer.addLeft(9 * kSecond, 0);
  EXPECT_EQ(textOf(pairer.addLeft(8 * kSecond + 20, 0)), Texts{});
  EXPECT_EQ(textOf(pairer.addRight(8 * kSecond + 30, 0)), Texts{"8000000020>8000000030"});
}

TEST(ScanPairer, GivesWhatTheWholeListsGiveHoweverTheStreamsInterleave) {
  Random random(5);
  std::vector<Stamp> lefts;
  std::vector<Stamp> rights;
  for (Stamp stamp = 10000; stamp < 30000; stamp += 100) {
    lefts.push_back(stamp + static_cast<Stamp>(random.uniform(0.0, 90.0)));
    if (random.uniform() < 0.9) {
      rights.push_back(stamp + static_cast<Stamp>(random.uniform(0.0, 90.0)));
    }
  }
  Pairer pairer(kPatience);
  std::vector<Pairer::Pair> pairs;
  const auto keep = [&pairs](const std::vector<Pairer::Pair>& more) {
    pairs.insert(pairs.end(), more.begin(), more.end());
  };
  std::size_t l = 0;
  std::size_t r = 0;
  while (l < lefts.size() || r < rights.size()) {
    const bool left_may = l < lefts.size() && (r == rights.size() || lefts[l] < rights[r] + 800);
    const bool right_may = r < rights.size() && (l == lefts.size() || rights[r] < lefts[l] + 800);
    if (left_may && (!right_may || random.uniform() < 0.5)) {
      keep(pairer.addLeft(lefts[l++], 0));
    } else {
      keep(pairer.addRight(rights[r++], 0));
    }
  }
  keep(pairer.flush());
  ASSERT_EQ(pairs.size(), lefts.size());
  for (std::size_t i = 0; i != pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].left_stamp, lefts[i]);
    ASSERT_TRUE(pairs[i].right);
    EXPECT_EQ(pairs[i].right->first, closestStamp(rights, lefts[i])) << lefts[i];
  }
}

}  // namespace
}  // namespace pcrb
