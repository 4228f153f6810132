#include "pcrb_core/run/merge_runs.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "pcrb_core/run/result.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "pcrb_core/run/run_info.hpp"
#include "run/some_results.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

namespace fs = std::filesystem;

using Access = ResultsStore::Access;
using pcrb_test::expectError;
using pcrb_test::fullResult;
using Info = std::map<std::string, std::string>;

constexpr const char* kSomeSecret = "000102030405060708090a0b0c0d0e0f";

Info infoOf(const std::string& shard, const std::string& problems) {
  return {{"shard", shard},  {"problems", problems}, {"secret", kSomeSecret},
          {"seed", "1"},     {"client", "/pcrb/me"}, {"cloud a.pcd", "11"},
          {"root", "/data"}, {"created", "1"}};
}

class MergeRunsTest : public ::testing::Test {
 protected:
  /// A finished shard; returns its folder.
  std::string makeShard(const std::string& name, const Info& info,
                        const std::vector<std::string>& ids) {
    ResultsStore store(folder_.file(name), Access::kReadWrite);
    store.setRunInfo(info);
    for (const auto& id : ids) store.add(fullResult(id));
    store.beginSession(10.0, name, 1);
    store.endSession(20.0);
    return folder_.file(name);
  }

  void makeTwo() {
    options_.runs = {makeShard("b", infoOf("1/2", "1"), {"2"}),
                     makeShard("a", infoOf("0/2", "2"), {"1", "3"})};
    options_.output = folder_.file("merged");
  }

  ResultsStore merged() const { return {options_.output, Access::kReadOnly}; }

  template <typename... Texts>
  void expectRefusal(const Texts&... texts) {
    expectError<StoreError>([&] { mergeRuns(options_); }, texts...);
    EXPECT_FALSE(fs::exists(options_.output + "/results.sqlite"));
  }

  pcrb_test::TemporaryFolder folder_;
  MergeOptions options_;
};

TEST_F(MergeRunsTest, GivesTheRunThatWouldHaveBeenWithoutShards) {
  makeTwo();
  const std::string summary = mergeRuns(options_).summary;
  EXPECT_NE(summary.find("total"), std::string::npos);
  EXPECT_EQ(merged().finished().size(), 3U);
  EXPECT_EQ(merged().sessions().size(), 2U);
  Info info = merged().runInfo();
  EXPECT_EQ(info["shard"], "0/1");
  EXPECT_EQ(info["problems"], "3");
  EXPECT_EQ(info["client"], "/pcrb/me");
  EXPECT_EQ(info["secret"], kSomeSecret);
  EXPECT_TRUE(fs::exists(options_.output + "/summary.txt"));
  EXPECT_TRUE(fs::exists(options_.output + "/results.csv"));
}

TEST_F(MergeRunsTest, OfShardsWithASecretEachKeepsThatOfEachProblem) {
  const std::string another = "ffffffffffffffffffffffffffffffff";
  Info first = infoOf("0/2", "1"), second = infoOf("1/2", "1");
  second["secret"] = another;
  first["presentation"] = second["presentation"] = "localization";
  options_.runs = {makeShard("a", first, {"1"}), makeShard("b", second, {"2"})};
  options_.output = folder_.file("merged");
  mergeRuns(options_);
  const auto secretOf = [this](const std::string& id) {
    return RunInfo::read(merged()).secretOf(fullResult(id).key).value().toHex();
  };
  EXPECT_EQ(merged().runInfo().count("secret"), 0U);
  EXPECT_EQ(secretOf("1"), kSomeSecret);
  EXPECT_EQ(secretOf("2"), another);

  options_.runs = {options_.output};  // itself a run of one shard
  options_.output = folder_.file("merged again");
  mergeRuns(options_);
  EXPECT_EQ(secretOf("2"), another);
}

TEST_F(MergeRunsTest, OfShardsWithASecretEachHasNoneWhereItMovedNothing) {
  Info second = infoOf("1/2", "1");
  second["secret"] = "ffffffffffffffffffffffffffffffff";
  options_.runs = {makeShard("a", infoOf("0/2", "1"), {"1"}), makeShard("b", second, {"2"})};
  options_.output = folder_.file("merged");
  mergeRuns(options_);
  for (const auto& [key, text] : merged().runInfo()) EXPECT_NE(key.rfind("secret", 0), 0U) << key;
}

TEST_F(MergeRunsTest, AddsUpWhatTheNodeUnderTestUsed) {
  Info first = infoOf("0/2", "1"), second = infoOf("1/2", "1");
  first["node_cpu_time_s"] = "1.5";
  first["node_peak_memory_bytes"] = "3000";
  second["node_cpu_time_s"] = "2.25";
  second["node_peak_memory_bytes"] = "1000";
  options_.runs = {makeShard("a", first, {"1"}), makeShard("b", second, {"2"})};
  options_.output = folder_.file("merged");
  mergeRuns(options_);
  EXPECT_EQ(merged().runInfo()["node_cpu_time_s"], "3.75");
  EXPECT_EQ(merged().runInfo()["node_peak_memory_bytes"], "3000");
}

TEST_F(MergeRunsTest, NamesShardsWhoseNodeNeverAnsweredAfterItHasWrittenAll) {
  makeTwo();
  EXPECT_EQ(mergeRuns(options_).defects, "");
  Result left = pcrb_test::minimalResult("2");
  left.outcome = Outcome::kFailed;
  left.reason = kNodeLeft;
  Result unable = left;
  unable.reason = "too few points";
  Result rejected = left;
  rejected.outcome = Outcome::kRejected;
  const Result late = pcrb_test::minimalResult("2");
  for (const Result& result : {left, rejected, late, unable}) {
    fs::remove_all(options_.output);
    fs::remove_all(options_.runs[0]);
    makeShard("b", infoOf("1/2", "1"), {});
    ResultsStore(options_.runs[0], Access::kReadWrite).add(result);
    const std::string defects = mergeRuns(options_).defects;
    EXPECT_EQ(merged().count(), 3U);
    if (result.reason == unable.reason) {
      EXPECT_EQ(defects, "");
    } else {
      EXPECT_EQ(defects.find(options_.runs[0] + " (shard 1/2): the node under test never"), 0U)
          << defects;
    }
  }
}

TEST_F(MergeRunsTest, ReplacesWhatAMergeLeftAndNothingElse) {
  makeTwo();
  mergeRuns(options_);
  fs::create_directories(options_.output + "/.merge");  // of a killed one
  mergeRuns(options_);
  EXPECT_EQ(merged().count(), 3U);
  options_.output = makeShard("run", infoOf("0/1", "1"), {"9"});
  expectError<StoreError>([&] { mergeRuns(options_); }, "no merge made");
  EXPECT_EQ(merged().count(), 1U);
}

TEST_F(MergeRunsTest, RefusesAnotherConfigurationAndNamesEveryDifference) {
  makeTwo();
  Info other = infoOf("0/2", "1");
  other["seed"] = "2";
  other["presentation"] = "localization";
  other["upright"] = "true";
  options_.runs[1] = makeShard("c", other, {"1"});
  expectRefusal("seed: `1` and `2`", "presentation: nothing and `localization`",
                "yaw_only: nothing and `true`");
}

TEST_F(MergeRunsTest, RefusesACloudThatChangedBetweenTwoShardsButNotOneThatOnlyOneUsed) {
  makeTwo();
  Info other = infoOf("0/2", "1");
  other.erase("cloud a.pcd");
  other["cloud b.pcd"] = "12";
  options_.runs[1] = makeShard("c", other, {"1"});
  mergeRuns(options_);
  EXPECT_EQ(merged().runInfo().count("cloud b.pcd"), 1U);
  fs::remove_all(options_.output);
  other["cloud a.pcd"] = "13";
  options_.runs[1] = makeShard("d", other, {"1"});
  expectRefusal("cloud a.pcd: `11` and `13`");
}

TEST_F(MergeRunsTest, RefusesAMissingOrDoubleShard) {
  makeTwo();
  options_.runs.pop_back();
  expectRefusal("missing are 0/2");
  options_.runs.push_back(makeShard("c", infoOf("1/2", "1"), {"4"}));
  expectRefusal("too, expected every shard once");
  options_.runs.back() = makeShard("d", infoOf("0/3", "1"), {"4"});
  expectRefusal("found a part of 3, expected one of 2");
}

TEST_F(MergeRunsTest, RefusesAShardWithProblemsThatHaveNoResult) {
  makeTwo();
  options_.runs[1] = makeShard("c", infoOf("0/2", "2"), {"1"});
  expectRefusal("found results of 1 problems, expected 2");
}

TEST_F(MergeRunsTest, RefusesShardsThatShareAProblem) {
  makeTwo();
  options_.runs[1] = makeShard("c", infoOf("0/2", "2"), {"1", "2"});
  expectRefusal("found a result of eth/plain local 2");
}

TEST_F(MergeRunsTest, RefusesWhatIsNoRun) {
  makeTwo();
  options_.runs[1] = folder_.file("nothing");
  expectRefusal("found no file");
  options_.runs[1] = makeShard("c", {{"key", "value"}}, {});
  expectRefusal("found shard ``");
}

}  // namespace
}  // namespace pcrb
