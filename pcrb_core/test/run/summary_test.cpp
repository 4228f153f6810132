#include "pcrb_core/run/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

Result makeResult(const std::string& data_set, const std::string& sequence, Kind kind,
                  Outcome outcome, double error) {
  Result result;
  result.key = {data_set, sequence, kind, "1"};
  result.outcome = outcome;
  result.error = error;
  return result;
}

TEST(Outcome, SurvivesItsText) {
  for (const Outcome outcome : {Outcome::kReplied, Outcome::kFailed, Outcome::kTimedOut,
                                Outcome::kRejected, Outcome::kSkipped}) {
    EXPECT_EQ(outcomeFromString(toString(outcome)), outcome);
  }
  EXPECT_STREQ(toString(Outcome::kTimedOut), "timed_out");
  EXPECT_THROW(outcomeFromString("Replied"), InvalidParameter);
  EXPECT_THROW(toString(static_cast<Outcome>(5)), InvalidParameter);
}

TEST(ProblemKey, IsOrderedByDataSetSequenceKindId) {
  const ProblemKey key{"eth", "plain", Kind::kLocal, "2"};
  EXPECT_LT(key, (ProblemKey{"kaist", "a", Kind::kLocal, "1"}));
  EXPECT_LT(key, (ProblemKey{"eth", "stairs", Kind::kLocal, "1"}));
  EXPECT_LT(key, (ProblemKey{"eth", "plain", Kind::kGlobal, "1"}));
  EXPECT_LT(key, (ProblemKey{"eth", "plain", Kind::kLocal, "3"}));
  EXPECT_EQ(key, (ProblemKey{"eth", "plain", Kind::kLocal, "2"}));
}

TEST(Summary, HasOneRowPerSequenceAndKindAndPoolsProblemsInTheTotal) {
  const auto summaries = summarize({
      makeResult("eth", "plain", Kind::kLocal, Outcome::kReplied, 0.1),
      makeResult("eth", "plain", Kind::kLocal, Outcome::kTimedOut, 0.3),
      makeResult("eth", "plain", Kind::kGlobal, Outcome::kFailed, 2.0),
      makeResult("eth", "apartment", Kind::kLocal, Outcome::kSkipped, 0.4),
  });
  ASSERT_EQ(summaries.size(), 4u);
  EXPECT_EQ(summaries[0].name, "apartment");
  EXPECT_EQ(summaries[1].name + " " + summaries[1].kind, "plain local");
  EXPECT_DOUBLE_EQ(summaries[1].error.median, 0.2);
  EXPECT_EQ(summaries[1].outcomes, (std::array<std::size_t, 5>{1, 0, 1, 0, 0}));
  EXPECT_EQ(summaries[2].name + " " + summaries[2].kind, "plain global");
  EXPECT_EQ(summaries[3].name + " " + summaries[3].kind, "total all");
  EXPECT_EQ(summaries[3].error.count, 4u);
  EXPECT_DOUBLE_EQ(summaries[3].error.median, 0.35);
  EXPECT_EQ(summaries[3].outcomes, (std::array<std::size_t, 5>{1, 1, 1, 0, 1}));
}

TEST(Summary, TellsSequencesOfOneNameInTwoDataSetsApart) {
  const auto summaries = summarize({
      makeResult("mine", "office", Kind::kLocal, Outcome::kReplied, 0.1),
      makeResult("yours", "office", Kind::kLocal, Outcome::kReplied, 0.2),
  });
  ASSERT_EQ(summaries.size(), 3u);
  EXPECT_EQ(summaries[0].name, "mine/office");
  EXPECT_EQ(summaries[1].name, "yours/office");
  EXPECT_EQ(summaries[2].kind, "local");
}

TEST(Summary, OfNoResultsIsATotalWithoutValues) {
  const auto summaries = summarize({});
  ASSERT_EQ(summaries.size(), 1u);
  EXPECT_EQ(summaries[0].error.count, 0u);
  EXPECT_TRUE(std::isnan(summaries[0].error.median));
  EXPECT_EQ(formatSummary(summaries).find("nan"), std::string::npos);
}

TEST(Summary, IsAnAlignedTable) {
  const std::string text = formatSummary(summarize({
      makeResult("eth", "plain", Kind::kLocal, Outcome::kReplied, 0.12344),
      makeResult("eth", "a_long_name", Kind::kLocal, Outcome::kTimedOut, 1.5e308),
      makeResult("eth", "höfe", Kind::kGlobal, Outcome::kReplied, 12.0),
  }));
  const std::string expected =
      R"(sequence     kind    count  replied  failed  timed_out  rejected  skipped       median          q75          q95         mean       stddev
a_long_name  local       1        0       0          1         0        0  1.5000e+308  1.5000e+308  1.5000e+308  1.5000e+308       0.0000
höfe         global      1        1       0          0         0        0      12.0000      12.0000      12.0000      12.0000       0.0000
plain        local       1        1       0          0         0        0       0.1234       0.1234       0.1234       0.1234       0.0000
total        all         3        2       0          1         0        0      12.0000  7.5000e+307  1.3500e+308  5.0000e+307  7.0711e+307
)";
  EXPECT_EQ(text, expected);
}

TEST(Summary, SaysWhatTheRepliesOfALocalizationNodeAreWorth) {
  Result better = makeResult("eth", "plain", Kind::kLocal, Outcome::kReplied, 0.1);
  better.initial_misalignment = 0.5;
  better.scans_used = 3;
  Result worse = better;
  worse.error = 0.75;
  worse.reason = std::string(kNotSettled) + " after 40 scans: the last answer";
  Result silent = makeResult("eth", "plain", Kind::kLocal, Outcome::kTimedOut, 0.5);
  EXPECT_EQ(describeScans({better, worse, silent}),
            "\ndo nothing: median 0.5000; worse than that: 1 of 2 replies; not settled: 1 of 2 "
            "replies\n");
  EXPECT_NE(describeScans({worse}).find("warning: the replies are worse than doing nothing"),
            std::string::npos);
  better.scans_used.reset();
  EXPECT_EQ(describeScans({better, silent}), "");
}

}  // namespace
}  // namespace pcrb
