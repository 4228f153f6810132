#include "verdict/threshold.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

using Words = std::vector<std::string>;

pcrb_msgs::SequenceSummary row(const std::string& name, const std::string& kind = "local") {
  pcrb_msgs::SequenceSummary row;
  row.name = name;
  row.kind = kind;
  row.count = 20;
  row.replied = 19;
  row.median = 0.1;
  row.q95 = 0.4;
  return row;
}

TEST(Threshold, WithoutANameIsForEveryRow) {
  const Threshold threshold("max_median", {"0.25"}, 1e9);
  EXPECT_EQ(threshold.of(row("hall")), 0.25);
  EXPECT_EQ(threshold.of(row("total", "all")), 0.25);
}

TEST(Threshold, TheMostParticularNameCounts) {
  const Threshold threshold("max_median", {"0.25", "hall=0.5", "hall:global=0.75"}, 1e9);
  EXPECT_EQ(threshold.of(row("kitchen")), 0.25);
  EXPECT_EQ(threshold.of(row("hall")), 0.5);
  EXPECT_EQ(threshold.of(row("hall", "global")), 0.75);
}

TEST(Threshold, IsNoneWhereNoneIsGiven) {
  EXPECT_EQ(Threshold().of(row("hall")), std::nullopt);
  EXPECT_EQ(Threshold("max_median", {"hall=0.5"}, 1e9).of(row("total")), std::nullopt);
}

TEST(Threshold, RefusesWhatIsNoValue) {
  for (const char* word : {"much", "=0.5", "hall=", "-0.1", "1.5", "nan", "hall=0,5"}) {
    EXPECT_THROW(Threshold("min_replied", {word}, 1.0), InvalidParameter) << word;
  }
  EXPECT_THROW(Threshold("min_replied", {"0.5", "0.6"}, 1.0), InvalidParameter);
}

TEST(Threshold, NamesThatAreNoRowAreTold) {
  const Threshold threshold("max_q95", {"1", "hall=1", "attic=1", "hall:global=1"}, 1e9);
  EXPECT_EQ(threshold.unusedNames({row("hall"), row("total")}), (Words{"attic", "hall:global"}));
}

TEST(Breaches, AreNoneWhenAllIsExactlyAtItsLimit) {
  const Thresholds thresholds{Threshold("m", {"0.1"}, 1e9), Threshold("q", {"0.4"}, 1e9),
                              Threshold("r", {"0.95"}, 1.0)};
  EXPECT_EQ(breaches(row("hall"), thresholds), Words{});
}

TEST(Breaches, AreAllToldWithWhatWasFoundAndExpected) {
  const Thresholds thresholds{Threshold("m", {"0.01"}, 1e9), Threshold("q", {"0.3"}, 1e9),
                              Threshold("r", {"1"}, 1.0)};
  EXPECT_EQ(breaches(row("hall"), thresholds),
            (Words{"median is 0.1, expected at most 0.01 (max_median)",
                   "q95 is 0.4, expected at most 0.3 (max_q95)",
                   "replied fraction is 0.95, expected at least 1 (min_replied)"}));
}

TEST(Breaches, ANumberThatIsNotOneKeepsNoThreshold) {
  auto empty = row("hall");
  empty.count = empty.replied = 0;
  empty.median = empty.q95 = std::nan("");
  const Thresholds thresholds{Threshold("m", {"1"}, 1e9), Threshold("q", {"1"}, 1e9),
                              Threshold("r", {"0"}, 1.0)};
  EXPECT_EQ(breaches(empty, thresholds).size(), 3U);
}

}  // namespace
}  // namespace pcrb
