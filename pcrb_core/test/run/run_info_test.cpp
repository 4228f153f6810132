#include "pcrb_core/run/run_info.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace pcrb {
namespace {

using Table = std::map<std::string, std::string>;
using Scope = RunInfo::Scope;

constexpr const char* kHex = "000102030405060708090a0b0c0d0e0f";

RunConfiguration someConfiguration() {
  RunConfiguration configuration;
  configuration.under_test = "my node";
  configuration.selection.root = "/data";
  configuration.selection.sequences = {"eth", "long"};
  configuration.selection.kinds = {Kind::kLocal, Kind::kGlobal};
  configuration.selection.subset = 30;
  configuration.selection.seed = 7;
  configuration.selection.shard = {2, 5};
  configuration.presentation = {PresentationKind::kLocalization, true};
  configuration.time_limit = 0.1;
  configuration.handshake = Handshake::kNone;
  configuration.global_guess = true;
  return configuration;
}

/// With a value for every member.
RunInfo someInfo() {
  RunInfo info;
  info.configuration = someConfiguration();
  info.code_version = "0.1.0";
  info.problem_files = {{"eth/plain_local.txt", "11"}};
  info.drawn_by = {{"eth/plain_local.txt", "sample_problems"}};
  info.voxel_leaves = {{"eth", "0.2"}};
  info.clouds = {{"eth/plain/a b.pcd", "22"}};
  info.secret = Secret::fromHex(kHex);
  info.created = 1.5;
  info.problems = 12;
  info.client = "/a /b";
  info.client_parameters = "";
  info.node_cpu_time = 0.25;
  info.node_peak_memory = 4096;
  info.merged_from = "2 shards";
  info.shard_secrets = {{"eth/plain local 1 2", kHex}};
  info.others = {{"of another version", "x"}};
  return info;
}

std::vector<std::string> parametersOf(const std::vector<RunInfo::Difference>& differences) {
  std::vector<std::string> parameters;
  for (const auto& difference : differences) parameters.push_back(difference.parameter);
  return parameters;
}

TEST(RunInfo, IsTheTableThatRunsHave) {
  const Table expected{{"client", "/a /b"},
                       {"client_parameters", ""},
                       {"cloud eth/plain/a b.pcd", "22"},
                       {"code_version", "0.1.0"},
                       {"created", "1.5"},
                       {"debug", "false"},
                       {"drawn_by eth/plain_local.txt", "sample_problems"},
                       {"global_guess", "true"},
                       {"handshake", "none"},
                       {"kinds", "local global"},
                       {"merged_from", "2 shards"},
                       {"metric_version", "1"},
                       {"node_cpu_time_s", "0.25"},
                       {"node_peak_memory_bytes", "4096"},
                       {"of another version", "x"},
                       {"presentation", "localization"},
                       {"problem_file eth/plain_local.txt", "11"},
                       {"problems", "12"},
                       {"root", "/data"},
                       {"secret", kHex},
                       {"secret eth/plain local 1 2", kHex},
                       {"seed", "7"},
                       {"sequences", "eth long"},
                       {"shard", "2/5"},
                       {"subset", "30"},
                       {"time_limit", "0.1"},
                       {"under_test", "my node"},
                       {"upright", "true"},
                       {"voxel_leaf eth", "0.2"}};
  EXPECT_EQ(someInfo().write(), expected);
  EXPECT_EQ(RunInfo::read(expected, "store").write(), expected);
}

TEST(RunInfo, KeepsAbsentKeysAbsentAndGivesTheirDefaults) {
  const Table table{{"seed", "3"}, {"shard", "0/1"}};
  const RunInfo info = RunInfo::read(table, "store");
  EXPECT_EQ(info.write(), table);
  EXPECT_EQ(info.configuration.presentation.kind, PresentationKind::kRegistration);
  EXPECT_FALSE(info.client.has_value());
  EXPECT_TRUE(info.isOfARun());
  EXPECT_FALSE(RunInfo::read({{"key", "value"}}, "store").isOfARun());
}

TEST(RunInfo, MarksOnlyRunsThatAreAuditedOrLiveOrHadForeignReplies) {
  RunInfo info;
  for (const char* key : {"audit", "results", "foreign_replies"}) {
    EXPECT_EQ(info.write().count(key), 0u) << key;
  }
  info.configuration.presentation.audit = true;
  info.configuration.results = ResultsTime::kLive;
  info.foreign_replies = 3;
  const RunInfo again = RunInfo::read(info.write(), "store");
  EXPECT_TRUE(again.configuration.presentation.audit);
  EXPECT_EQ(again.configuration.results, ResultsTime::kLive);
  EXPECT_EQ(again.foreign_replies, 3u);
  EXPECT_EQ(parametersOf(RunInfo().differences(info, Scope::kResume)),
            (std::vector<std::string>{"audit", "results"}));
}

TEST(RunInfo, RefusesATextThatIsNoValueOfItsKey) {
  for (const auto& [key, text] : Table{{"seed", "-1"},
                                       {"subset", "many"},
                                       {"shard", "3/3"},
                                       {"presentation", "both"},
                                       {"upright", "True"},
                                       {"time_limit", "long"},
                                       {"handshake", "maybe"},
                                       {"secret", "12"},
                                       {"secret eth/plain local 1", "12"},
                                       {"created", ""},
                                       {"problems", "1.5"},
                                       {"kinds", "local both"}}) {
    pcrb_test::expectError<StoreError>(
        [&, k = key, t = text] {
          RunInfo::read({{k, t}}, "a.sqlite");
        },
        "a.sqlite: run table, " + key, "found");
  }
}

TEST(RunInfo, ComparesOfARunThatGoesOnItsConfigurationProblemFilesAndShard) {
  RunInfo other = someInfo();
  other.configuration.selection.root = "/elsewhere";
  other.configuration.selection.shard = {3, 5};
  other.configuration.time_limit = 5.0;
  other.problem_files = {{"eth/plain_local.txt", "12"}};
  other.client = "/c";
  other.created = 2.0;
  other.clouds.clear();
  const auto differences = someInfo().differences(other, Scope::kResume);
  EXPECT_EQ(parametersOf(differences),
            (std::vector<std::string>{"problem_file eth/plain_local.txt", "shard", "time_limit"}));
  EXPECT_EQ(differences[2].here, "0.1");
  EXPECT_EQ(differences[2].there, "5");
  EXPECT_EQ(parametersOf(someInfo().differences(other, Scope::kClient)),
            std::vector<std::string>{"client"});
}

TEST(RunInfo, GoesOnWithTheSameVoxelLeafAndWhereAnOlderRunHasNone) {
  RunInfo other = someInfo();
  other.voxel_leaves = {{"eth", "0.1"}};
  EXPECT_EQ(parametersOf(someInfo().differences(other, Scope::kResume)),
            std::vector<std::string>{"voxel_leaf eth"});
  other.voxel_leaves.clear();
  EXPECT_TRUE(someInfo().differences(other, Scope::kResume).empty());
}

TEST(RunInfo, ComparesOfShardsAllButWhatTellsThemApart) {
  RunInfo other = someInfo();
  other.configuration.selection.root = "/elsewhere";
  other.configuration.selection.shard = {3, 5};
  other.secret = Secret::draw();
  other.shard_secrets.clear();
  other.created = 2.0;
  other.problems = 13;
  other.node_cpu_time = 9.0;
  other.clouds = {{"eth/plain/b.pcd", "33"}};
  EXPECT_TRUE(someInfo().differences(other, Scope::kShards).empty());
  other.clouds = {{"eth/plain/a b.pcd", "33"}};
  other.code_version = "0.2.0";
  other.client_parameters = "[a:1]";
  other.others["of another version"] = "y";
  EXPECT_EQ(parametersOf(someInfo().differences(other, Scope::kShards)),
            (std::vector<std::string>{"client_parameters", "cloud eth/plain/a b.pcd",
                                      "code_version", "of another version"}));
}

TEST(RunInfo, TakesInWhatAnotherShardHasNoted) {
  RunInfo merged = someInfo();
  RunInfo other = someInfo();
  other.clouds = {{"eth/plain/b.pcd", "33"}};
  other.node_cpu_time = 1.0;
  other.node_peak_memory = 100;
  other.problems = 3;
  merged.merge(other);
  EXPECT_EQ(merged.clouds.size(), 2u);
  EXPECT_EQ(merged.node_cpu_time, 1.25);
  EXPECT_EQ(merged.node_peak_memory, 4096u);
  EXPECT_EQ(merged.problems, 15u);
}

TEST(RunInfo, ShowsReadersNeitherSecretsNorHashes) {
  for (const auto& [key, text] : someInfo().writeShown()) {
    EXPECT_EQ(text.find(kHex), std::string::npos) << key;
    EXPECT_EQ(key.find(' '), std::string::npos) << key;
  }
  EXPECT_EQ(someInfo().writeShown().at("seed"), "7");
}

}  // namespace
}  // namespace pcrb
