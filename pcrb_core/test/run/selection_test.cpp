#include "run/selection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/random.hpp"
#include "support/shared_data.hpp"

namespace pcrb {
namespace {

using Positions = std::vector<std::size_t>;

PlannedProblem planned(const ProblemKey& key, const std::string& source,
                       const std::string& target) {
  PlannedProblem problem;
  problem.key = key;
  problem.problem.source = source;
  problem.problem.target = target;
  return problem;
}

/// Appends problems with consecutive ids of one pair of clouds.
void addPair(std::vector<PlannedProblem>& list, const std::string& sequence, Kind kind,
             const std::string& source, const std::string& target, int count) {
  for (int i = 0; i < count; ++i) {
    const std::string id = std::to_string(1000000 + list.size());
    list.push_back(planned({"eth", sequence, kind, id}, source, target));
  }
}

/// Two sequences of different size, one with both kinds; targets with several sources.
std::vector<PlannedProblem> someProblems() {
  std::vector<PlannedProblem> list;
  for (const char* target : {"a", "b", "c"}) {
    for (const char* source : {"s", "t", "u", "v"}) {
      addPair(list, "plain", Kind::kLocal, source, target, 30);
      addPair(list, "plain", Kind::kGlobal, source, target, 1);
    }
  }
  addPair(list, "stairs", Kind::kLocal, "s", "a", 30);
  addPair(list, "stairs", Kind::kLocal, "t", "b", 30);
  return list;
}

std::vector<PlannedProblem> publishedProblems() {
  std::vector<PlannedProblem> list;
  for (const char* name : {"plain_local", "p2at_met_global", "planetary_map_local"}) {
    const std::string text = name;
    const std::size_t separator = text.rfind('_');
    const Kind kind = kindFromString(text.substr(separator + 1));
    for (const Problem& problem :
         readProblemFile(pcrb_test::sharedData() + "/official/" + text + ".txt")) {
      list.push_back(planned({"set", text.substr(0, separator), kind, problem.id}, problem.source,
                             problem.target));
    }
  }
  return list;
}

/// How many chosen problems have each value of a key.
template <typename Key>
auto countBy(const std::vector<PlannedProblem>& list, const Positions& chosen, const Key& key) {
  std::map<decltype(key(list.front())), std::size_t> counts;
  for (const std::size_t position : chosen) ++counts[key(list.at(position))];
  return counts;
}

auto stratumOf(const PlannedProblem& c) { return c.key.sequence + " " + toString(c.key.kind); }
auto pairOf(const PlannedProblem& c) {
  return stratumOf(c) + " " + c.problem.source + " " + c.problem.target;
}
auto idOf(const PlannedProblem& c) { return c.key.sequence + " " + c.key.problem_id; }

Positions all(const std::vector<PlannedProblem>& list) {
  Positions positions(list.size());
  std::iota(positions.begin(), positions.end(), std::size_t{0});
  return positions;
}

std::set<std::string> idsOf(const std::vector<PlannedProblem>& list, const Positions& chosen) {
  std::set<std::string> ids;
  for (const std::size_t position : chosen) ids.insert(idOf(list.at(position)));
  EXPECT_EQ(ids.size(), chosen.size());
  return ids;
}

TEST(Allocation, GivesWholePartsThenLargestRemainders) {
  // 10 of 100: quotas 5.5, 3.2, 1.3.
  EXPECT_EQ(allocateProportionally({55, 32, 13}, 10), (Positions{6, 3, 1}));
  EXPECT_EQ(allocateProportionally({10, 10, 10}, 5), (Positions{2, 2, 1}));  // ties to the earlier
  EXPECT_EQ(allocateProportionally({7, 0, 3}, 10), (Positions{7, 0, 3}));
  EXPECT_EQ(allocateProportionally({}, 0), Positions{});
}

TEST(Allocation, GivesOneToTheSmallestAndSharesTheRestInProportion) {
  EXPECT_EQ(allocateProportionally({3000, 1500, 1, 1}, 11), (Positions{6, 3, 1, 1}));
  EXPECT_EQ(allocateProportionally({3000, 100, 50}, 3), (Positions{1, 1, 1}));
  EXPECT_EQ(allocateProportionally({50, 3000, 100}, 2), (Positions{0, 1, 1}));
}

TEST(Allocation, IsCompleteAndNeverMoreThanThereIs) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    Positions sizes;
    for (std::uint64_t k = random.below(8); k > 0; --k) {
      sizes.push_back(random.below(1 + random.below(100)));
    }
    const std::size_t total = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    const std::size_t count = random.below(total + 1);
    const auto shares = allocateProportionally(sizes, count);
    EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), std::size_t{0}), count);
    for (std::size_t k = 0; k < sizes.size(); ++k) EXPECT_LE(shares[k], sizes[k]);
  }
}

TEST(Allocation, RefusesMoreThanThereIs) {
  EXPECT_THROW(allocateProportionally({1, 2}, 4), InvalidParameter);
}

TEST(Subset, OfNoneOrTooManyIsAll) {
  const auto list = someProblems();
  EXPECT_EQ(drawSubset(list, 0, 1), all(list));
  EXPECT_EQ(drawSubset(list, list.size() + 1, 1), all(list));
  EXPECT_EQ(drawSubset({}, 5, 1), Positions{});
}

TEST(Subset, IsSharedAmongSequencesAndKindsInProportion) {
  const auto list = someProblems();  // 360, 12 and 60 problems
  const auto counts = countBy(list, drawSubset(list, 36, 1), stratumOf);
  EXPECT_EQ(counts.at("plain local"), 30u);
  EXPECT_EQ(counts.at("plain global"), 1u);
  EXPECT_EQ(counts.at("stairs local"), 5u);
}

TEST(Subset, IsSpreadEvenlyOverPairsOfClouds) {
  const auto list = someProblems();
  for (const auto& [pair, count] : countBy(list, drawSubset(list, 36, 1), pairOf)) {
    if (pair.find("plain local") == 0) {
      EXPECT_TRUE(count == 2 || count == 3) << pair;  // 30 over 12
    }
  }
}

TEST(Subset, DrawsPerturbationsThatDifferFromPairToPair) {
  const auto list = someProblems();
  std::set<std::size_t> indices;
  for (const std::size_t position : drawSubset(list, 36, 1)) indices.insert(position % 31);
  EXPECT_GT(indices.size(), 10u);
}

TEST(Subset, DependsOnTheSeedAndOnNothingElse) {
  const auto list = someProblems();
  EXPECT_EQ(drawSubset(list, 36, 1), drawSubset(list, 36, 1));
  EXPECT_NE(drawSubset(list, 36, 1), drawSubset(list, 36, 2));
  auto shuffled = list;
  Random(3).shuffle(shuffled);
  EXPECT_EQ(idsOf(shuffled, drawSubset(shuffled, 36, 1)), idsOf(list, drawSubset(list, 36, 1)));
}

TEST(Subset, IsTheSameOnEveryPlatform) {
  const auto list = someProblems();
  EXPECT_EQ(drawSubset(list, 5, 42), (Positions{31, 61, 230, 308, 431}));
}

TEST(Shard, PartsAreDisjointCompleteAndOfEqualSize) {
  const auto list = someProblems();
  for (const std::size_t shards : {1u, 2u, 3u, 7u, 32u, 433u}) {
    Positions together;
    for (std::size_t shard = 0; shard < shards; ++shard) {
      const Positions part = selectShard(list, shard, shards);
      EXPECT_TRUE(part.size() == list.size() / shards || part.size() == list.size() / shards + 1);
      EXPECT_TRUE(std::is_sorted(part.begin(), part.end()));
      together.insert(together.end(), part.begin(), part.end());
    }
    std::sort(together.begin(), together.end());
    EXPECT_EQ(together, all(list)) << shards;
  }
}

TEST(Shard, HasItsPartOfEverySequenceAndKind) {
  const auto list = someProblems();
  for (std::size_t shard = 0; shard < 7; ++shard) {
    const auto counts = countBy(list, selectShard(list, shard, 7), stratumOf);
    EXPECT_NEAR(static_cast<double>(counts.at("plain local")), 360.0 / 7, 1.0);
    EXPECT_NEAR(static_cast<double>(counts.at("plain global")), 12.0 / 7, 1.0);
    EXPECT_NEAR(static_cast<double>(counts.at("stairs local")), 60.0 / 7, 1.0);
  }
}

TEST(Shard, KeepsTheProblemsOfATargetTogetherButForTheCuts) {
  const auto list = someProblems();
  std::map<std::string, std::set<std::size_t>> shards_of_target;
  for (std::size_t shard = 0; shard < 3; ++shard) {
    for (const std::size_t position : selectShard(list, shard, 3)) {
      const PlannedProblem& c = list[position];
      shards_of_target[stratumOf(c) + " " + c.problem.target].insert(shard);
    }
  }
  for (const char* target : {"plain local a", "plain local b", "plain local c"}) {
    EXPECT_EQ(shards_of_target.at(target).size(), 1u) << target;
  }
}

TEST(Shard, OfATargetThatIsCutHasAllItsSources) {
  std::vector<PlannedProblem> list;
  for (const char* source : {"s", "t", "u"}) addPair(list, "map", Kind::kLocal, source, "map", 30);
  for (std::size_t shard = 0; shard < 9; ++shard) {
    EXPECT_EQ(countBy(list, selectShard(list, shard, 9), pairOf).size(), 3u);
  }
}

TEST(Shard, DoesNotDependOnTheOrderOfTheList) {
  const auto list = someProblems();
  auto shuffled = list;
  Random(3).shuffle(shuffled);
  EXPECT_EQ(idsOf(shuffled, selectShard(shuffled, 2, 5)), idsOf(list, selectShard(list, 2, 5)));
}

TEST(Shard, RefusesNumbersThatThereAreNot) {
  EXPECT_THROW(selectShard({}, 0, 0), InvalidParameter);
  EXPECT_THROW(selectShard({}, 2, 2), InvalidParameter);
}

/// In a serving order: how often a target's problems begin, and how often a problem follows one of
/// the same source and target.
struct OrderCounts {
  OrderCounts(const std::vector<PlannedProblem>& list, const Positions& order) {
    const PlannedProblem* before = nullptr;
    for (const std::size_t position : order) {
      const PlannedProblem& c = list.at(position);
      const bool is_new = before == nullptr || c.key.sequence != before->key.sequence ||
                          c.problem.target != before->problem.target;
      targets += is_new ? 1 : 0;
      repeated_sources += !is_new && c.problem.source == before->problem.source ? 1 : 0;
      before = &c;
    }
  }

  int targets = 0;
  int repeated_sources = 0;
};

const Secret kSecret = Secret::fromHex("000102030405060708090a0b0c0d0e0f");

TEST(SecretOrder, HasEveryProblemOnce) {
  const auto list = someProblems();
  Positions order = secretOrder(list, kSecret);
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, all(list));
  EXPECT_EQ(secretOrder({}, kSecret), Positions{});
}

TEST(SecretOrder, TakesEveryTargetOnceOverBothKindsAndChangesSources) {
  const auto list = someProblems();
  const OrderCounts counts(list, secretOrder(list, kSecret));
  EXPECT_EQ(counts.targets, 5);
  EXPECT_EQ(counts.repeated_sources, 58);  // the two targets with one source, 30 problems each
}

TEST(SecretOrder, RepeatsASourceOnlyWhereItHasMoreThanHalf) {
  for (const int majority : {1, 5, 10, 11, 12, 20}) {
    std::vector<PlannedProblem> list;
    addPair(list, "plain", Kind::kLocal, "major", "a", majority);
    addPair(list, "plain", Kind::kLocal, "s", "a", 5);
    addPair(list, "plain", Kind::kLocal, "t", "a", 5);
    for (int i = 0; i < 20; ++i) {
      const OrderCounts counts(list, secretOrder(list, Secret::draw()));
      EXPECT_EQ(counts.repeated_sources, std::max(0, majority - 11)) << majority;
    }
  }
}

TEST(SecretOrder, KeepsTheListsOrderOfSequences) {
  const auto list = someProblems();
  const Positions order = secretOrder(list, kSecret);
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(list.at(order[i]).key.sequence, i < 372 ? "plain" : "stairs");
  }
}

TEST(SecretOrder, IsFixedByTheSecretAndUnlikeAnother) {
  const auto list = someProblems();
  EXPECT_EQ(secretOrder(list, kSecret), secretOrder(list, kSecret));
  EXPECT_NE(secretOrder(list, kSecret), secretOrder(list, Secret::draw()));
}

TEST(SecretOrder, PutsEveryPerturbationOfAPairAtAnyPlace) {
  std::vector<PlannedProblem> list;
  addPair(list, "plain", Kind::kLocal, "s", "a", 5);
  std::map<std::size_t, int> first;
  constexpr int kRuns = 1000;
  for (int i = 0; i < kRuns; ++i) ++first[secretOrder(list, Secret::draw()).front()];
  EXPECT_EQ(first.size(), 5u);
  for (const auto& [position, count] : first) EXPECT_NEAR(count, kRuns / 5, 75);  // 6 sigma
}

TEST(SecretOrder, OfThePublishedProblemsChangesSourcesWhereTheTargetHasSeveral) {
  PCRB_REQUIRE_SHARED_DATA();
  const auto list = publishedProblems();
  ASSERT_EQ(list.size(), 3000u + 100u + 3060u);
  std::map<std::string, std::map<std::string, int>> sources_of_target;
  for (const PlannedProblem& c : list)
    ++sources_of_target[c.key.sequence + " " + c.problem.target][c.problem.source];
  int expected = 0;
  for (const auto& [target, sources] : sources_of_target) {
    int total = 0;
    int most = 0;
    for (const auto& [source, count] : sources) {
      total += count;
      most = std::max(most, count);
    }
    expected += std::max(0, most - (total - most) - 1);
  }
  const OrderCounts counts(list, secretOrder(list, kSecret));
  EXPECT_EQ(counts.targets, static_cast<int>(sources_of_target.size()));
  EXPECT_EQ(counts.repeated_sources, expected);
}

}  // namespace
}  // namespace pcrb
