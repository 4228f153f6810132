#include "pcrb_core/problem/pair_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "support/shared_data.hpp"

namespace pcrb {
namespace {

std::string nameOf(const CloudPair& pair) { return pair.source + " " + pair.target; }

std::vector<CloudPair> evenPairs(std::size_t n, double low, double high) {
  std::vector<CloudPair> pairs;
  for (std::size_t i = 0; i < n; ++i) {
    const double part = n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0.0;
    pairs.push_back({"s" + std::to_string(i), "t", low + part * (high - low)});
  }
  return pairs;
}

std::map<std::string, int> countByName(const std::vector<CloudPair>& pairs) {
  std::map<std::string, int> counts;
  for (const CloudPair& pair : pairs) ++counts[nameOf(pair)];
  return counts;
}

/// Pairs of the sample in each of the ten intervals of `eligible`.
std::vector<std::size_t> coverage(const std::vector<CloudPair>& eligible,
                                  const std::vector<CloudPair>& sample) {
  const std::vector<std::size_t> intervals = overlapIntervals(eligible);
  std::map<std::string, std::size_t> interval_of;
  for (std::size_t i = 0; i < eligible.size(); ++i) interval_of[nameOf(eligible[i])] = intervals[i];
  std::vector<std::size_t> counts(kOverlapIntervals, 0);
  for (const CloudPair& pair : sample) ++counts[interval_of.at(nameOf(pair))];
  return counts;
}

TEST(PairSampling, EligibleAreKnownOverlapsFromTheThresholdUpToOne) {
  OverlapMatrix matrix({"a", "b", "c"});
  matrix.at(0, 1) = 0.4;
  matrix.at(1, 0) = 0.6;
  matrix.at(0, 2) = 0.3999;
  matrix.at(2, 0) = 1.0;
  const auto names = [&](Kind kind) {
    std::vector<std::string> found;
    for (const CloudPair& pair : eligiblePairs(matrix, kind)) found.push_back(nameOf(pair));
    return found;
  };
  EXPECT_EQ(names(Kind::kLocal), (std::vector<std::string>{"a b", "b a"}));
  EXPECT_EQ(names(Kind::kGlobal), (std::vector<std::string>{"b a"}));
}

TEST(PairSampling, IntervalsAreHalfOpenButTheLast) {
  std::vector<CloudPair> pairs;
  for (const double overlap : {0.0, 0.05, 0.1, 0.1999, 0.2, 0.9, 0.95, 1.0}) {
    pairs.push_back({"s", "t", overlap});
  }
  EXPECT_EQ(overlapIntervals(pairs), (std::vector<std::size_t>{0, 0, 1, 1, 2, 9, 9, 9}));
}

TEST(PairSampling, DrawsTenDifferentPairsFromEveryInterval) {
  const std::vector<CloudPair> eligible = evenPairs(1000, 0.4, 0.95);
  Random random(7);
  const std::vector<CloudPair> sample = samplePairs(eligible, 100, random);
  EXPECT_EQ(coverage(eligible, sample), std::vector<std::size_t>(10, 10));
  EXPECT_EQ(countByName(sample).size(), 100U);
  EXPECT_LT(sample.front().overlap, sample.back().overlap);
}

TEST(PairSampling, TopsUpADryIntervalEvenlyWithPairsNotYetTaken) {
  std::vector<CloudPair> eligible = evenPairs(500, 0.5, 0.85);
  eligible.push_back({"low", "t", 0.4});  // the only one of the first interval
  eligible.push_back({"high", "t", 0.9});
  Random random(8);
  const std::vector<CloudPair> sample = samplePairs(eligible, 100, random);
  EXPECT_EQ(countByName(sample).size(), 100U);
  EXPECT_EQ(coverage(eligible, sample),
            (std::vector<std::size_t>{1, 0, 14, 14, 14, 14, 14, 14, 14, 1}));
}

TEST(PairSampling, TopsUpFromAllThatIsLeftAsThePaperDoes) {
  std::vector<CloudPair> eligible{{"low", "t", 0.4}, {"high", "t", 0.9}};
  for (const double middle : {0.475, 0.525, 0.575, 0.625, 0.675, 0.725, 0.775, 0.825}) {
    const std::size_t n = middle > 0.6 && middle < 0.65 ? 2000 : 20;
    for (std::size_t i = 0; i < n; ++i) {
      eligible.push_back({std::to_string(middle) + " " + std::to_string(i), "t", middle});
    }
  }
  Random random(8);
  const auto sample = samplePairs(eligible, 100, random, TopUp::kPaper);
  EXPECT_EQ(countByName(sample).size(), 100U);
  const auto counts = coverage(eligible, sample);
  EXPECT_EQ(counts.front(), 1U);
  EXPECT_EQ(counts.back(), 1U);
  for (std::size_t i = 1; i < 9; ++i) EXPECT_GE(counts[i], 10U) << i;
  EXPECT_GE(counts[4], 24U) << "nearly all of the 18 that lack are of the dense interval";
  const auto few = samplePairs(evenPairs(37, 0.4, 0.9), 100, random, TopUp::kPaper);
  EXPECT_EQ(countByName(few).size(), 37U);
}

TEST(PairSampling, DrawsTheSameWhereNothingLacks) {
  const std::vector<CloudPair> eligible = evenPairs(1000, 0.4, 0.95);
  const auto namesOf = [&](TopUp top_up) {
    Random random(7);
    std::string names;
    for (const CloudPair& pair : samplePairs(eligible, 100, random, top_up)) names += nameOf(pair);
    return names;
  };
  EXPECT_EQ(namesOf(TopUp::kEven), namesOf(TopUp::kPaper));
}

TEST(PairSampling, RepeatsOnlyWhenPairsAreTooFewAndThenAllAlike) {
  const std::vector<CloudPair> eligible = evenPairs(37, 0.4, 0.9);
  Random random(9);
  const std::vector<CloudPair> sample = samplePairs(eligible, 100, random);
  ASSERT_EQ(sample.size(), 100U);
  const auto counts = countByName(sample);
  EXPECT_EQ(counts.size(), 37U);
  for (const auto& [name, count] : counts) {
    EXPECT_GE(count, 2) << name;
    EXPECT_LE(count, 3) << name;
  }
}

TEST(PairSampling, EveryPairOfAnIntervalIsEquallyLikely) {
  const std::vector<CloudPair> eligible = evenPairs(200, 0.4, 0.9);  // 20 in each interval
  std::map<std::string, int> counts;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    for (const CloudPair& pair : samplePairs(eligible, 100, random)) ++counts[nameOf(pair)];
  }
  // Each is drawn in half of the 400 samples; six standard deviations are 60.
  ASSERT_EQ(counts.size(), 200U);
  for (const auto& [name, count] : counts) EXPECT_NEAR(count, 200, 60) << name;
}

TEST(PairSampling, SameSeedGivesTheSamePairs) {
  const std::vector<CloudPair> eligible = evenPairs(300, 0.4, 0.9);
  const auto draw = [&](std::uint64_t seed) {
    Random random(seed);
    std::string names;
    for (const CloudPair& pair : samplePairs(eligible, 100, random)) names += nameOf(pair) + '\n';
    return names;
  };
  EXPECT_EQ(draw(5), draw(5));
  EXPECT_NE(draw(5), draw(6));
}

TEST(PairSampling, CopesWithEqualOverlapsAndRefusesNoPairs) {
  Random random(1);
  EXPECT_EQ(samplePairs(evenPairs(150, 0.5, 0.5), 100, random).size(), 100U);
  EXPECT_EQ(samplePairs(evenPairs(1, 0.5, 0.5), 100, random).size(), 100U);
  EXPECT_THROW(samplePairs({}, 100, random), InvalidProblem);
}

/// Sum of squared deviations from ten pairs per interval.
double unevenness(const std::vector<std::size_t>& counts) {
  double sum = 0.0;
  for (const std::size_t count : counts) {
    sum += (static_cast<double>(count) - 10.0) * (static_cast<double>(count) - 10.0);
  }
  return sum;
}

/// No other hundred different pairs of these matrices, those of the published lists included, cover
/// the intervals more evenly: an interval has fewer pairs than another only if it has no more.
TEST(PairSampling, CoversPublishedMatricesAsEvenlyAsTheyAllow) {
  PCRB_REQUIRE_SHARED_DATA();
  for (const char* name : {"apartment", "pioneer_slam3"}) {
    const OverlapMatrix matrix =
        readOverlapMatrix(pcrb_test::sharedData() + "/overlap/" + name + "_overlap.txt");
    for (const Kind kind : {Kind::kLocal, Kind::kGlobal}) {
      const std::vector<CloudPair> eligible = eligiblePairs(matrix, kind);
      Random random(1);
      const std::vector<CloudPair> sample = samplePairs(eligible, kPairsPerList, random);
      EXPECT_EQ(countByName(sample).size(), kPairsPerList);
      const auto counts = coverage(eligible, sample);
      const auto available = coverage(eligible, eligible);
      const std::size_t most = *std::max_element(counts.begin(), counts.end());
      for (std::size_t i = 0; i < kOverlapIntervals; ++i) {
        EXPECT_GE(counts[i], std::min(available[i], most - 1)) << name << " interval " << i;
      }
    }
  }
}

TEST(PairSampling, CoversAtLeastAsEvenlyAsThePublishedSelections) {
  PCRB_REQUIRE_SHARED_DATA();
  for (const char* name : {"plain_local.txt", "urban05_local.txt", "p2at_met_global.txt"}) {
    std::vector<CloudPair> published;
    for (const Problem& problem : readProblemFile(pcrb_test::sharedData() + "/official/" + name)) {
      const bool is_first = published.empty() || published.back().source != problem.source ||
                            published.back().target != problem.target;
      if (is_first) published.push_back({problem.source, problem.target, problem.overlap});
    }
    std::vector<CloudPair> different;
    std::set<std::string> seen;
    for (const CloudPair& pair : published) {
      if (seen.insert(nameOf(pair)).second) different.push_back(pair);
    }
    Random random(1);
    EXPECT_LE(unevenness(coverage(different, samplePairs(different, published.size(), random))),
              unevenness(coverage(different, published)))
        << name;
  }
}

}  // namespace
}  // namespace pcrb
