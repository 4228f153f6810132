#include "benchmarking/batch_tool.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "benchmarking/child_process.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "run/some_results.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using Words = std::vector<std::string>;

BatchOptions optionsIn(const std::string& folder) {
  BatchOptions options;
  options.run = folder;
  options.arguments = {"root:=" + folder, "method:=icp"};
  options.jobs = 3;
  return options;
}

/// To the first shard of a batch.
void addResult(const std::string& run) {
  pcrb::ResultsStore store(run + "/shards/0", pcrb::ResultsStore::Access::kReadWrite);
  store.setRunInfo({{"seed", "7"}});
  store.add(pcrb_test::fullResult("4215528471000"));
}

TEST(LaunchArguments, AreThoseOfTheLaunchFileAndNotThoseThatRoslaunchAppends) {
  Words words{"evaluate_batch", "--run",       "a",     "root:=/data",
              "__name:=batch",  "__log:=/log", "kind:="};
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  EXPECT_EQ(launchArguments(static_cast<int>(argv.size()), argv.data()),
            (Words{"root:=/data", "kind:="}));
}

TEST(LaunchArguments, AreRefusedWhereRoslaunchTakesNoSuchBytes) {
  const pcrb_test::TemporaryFolder folder;
  const char* const expected = "expected UTF-8: roslaunch takes no other bytes in a path";
  BatchOptions options = optionsIn(folder.path());
  EXPECT_EQ(launchCommand(options).size(), 5U);
  options.arguments.push_back("parameters:=/caf\xc3\xa9.yaml");
  EXPECT_EQ(launchCommand(options).back(), "parameters:=/caf\xc3\xa9.yaml");
  options.arguments.push_back("plugin:=/caf\xe9.so");
  pcrb_test::expectError<pcrb::InvalidParameter>([&] { launchCommand(options); },
                                                 "found `plugin:=/caf\xef\xbf\xbd.so`", expected);
  options.arguments.pop_back();
  options.run = folder.file("caf\xe9");
  pcrb_test::expectError<pcrb::InvalidParameter>([&] { launchCommand(options); }, expected);
}

TEST(LaunchArguments, HaveAbsolutePathsSinceNodesStartElsewhere) {
  const pcrb_test::TemporaryFolder folder;
  BatchOptions options = optionsIn(folder.path());
  const std::string here = std::filesystem::current_path().string();
  const auto last = [&](const std::string& argument) {
    options.arguments.push_back(argument);
    return launchCommand(options).back();
  };
  EXPECT_EQ(last("parameters:=mine/my.yaml"), "parameters:=" + here + "/mine/my.yaml");
  EXPECT_EQ(last("parameters:="), "parameters:=");
  EXPECT_EQ(last("plugin:=libmine.so"), "plugin:=libmine.so");  // the system's loader finds it
  EXPECT_EQ(last("plugin:=."),
            "plugin:=" + std::filesystem::path(here + "/.").lexically_normal().string());
}

TEST(BatchConfiguration, GoesOnWithItsNumberOfShardsWhateverTheJobs) {
  const pcrb_test::TemporaryFolder folder;
  BatchOptions options = optionsIn(folder.path());
  EXPECT_EQ(numberOfShards(options), 3);
  noteConfiguration(options, 3);
  options.jobs = 8;
  EXPECT_EQ(numberOfShards(options), 3);
  noteConfiguration(options, 3);
}

TEST(BatchConfiguration, TakesArgumentsInAnyOrderAndRefusesOthers) {
  const pcrb_test::TemporaryFolder folder;
  BatchOptions options = optionsIn(folder.path());
  noteConfiguration(options, 3);
  addResult(folder.path());
  std::swap(options.arguments[0], options.arguments[1]);
  noteConfiguration(options, 3);
  options.arguments[0] = "method:=ndt";
  pcrb_test::expectError<pcrb::Error>([&] { noteConfiguration(options, 4); },
                                      "found `shards 3` `method:=icp`",
                                      "asked for `shards 4` `method:=ndt`");
}

TEST(BatchConfiguration, TakesOtherArgumentsAsLongAsNoProblemHasAResult) {
  const pcrb_test::TemporaryFolder folder;
  BatchOptions options = optionsIn(folder.path());
  noteConfiguration(options, 3);
  {
    const pcrb::ResultsStore begun(folder.path() + "/shards/0",
                                   pcrb::ResultsStore::Access::kReadWrite);
  }
  options.arguments[1] = "method:=ndt";
  noteConfiguration(options, 3);
  addResult(folder.path());
  options.arguments[1] = "method:=icp";
  pcrb_test::expectError<pcrb::Error>([&] { noteConfiguration(options, 3); }, "found `method:=ndt`",
                                      "asked for `method:=icp`");
}

TEST(BatchConfiguration, RefusesOtherContentOfAFileThatAnArgumentNames) {
  const pcrb_test::TemporaryFolder folder;
  const std::string file = folder.file("icp.yaml");
  BatchOptions options = optionsIn(folder.path());
  options.arguments.push_back("parameters:=" + file);
  std::ofstream(file) << "max_iterations: 35\n";
  noteConfiguration(options, 3);
  addResult(folder.path());
  noteConfiguration(options, 3);
  std::ofstream(file) << "max_iterations: 1\n";
  pcrb_test::expectError<pcrb::Error>([&] { noteConfiguration(options, 3); },
                                      "another batch: found `parameters:=" + file,
                                      "asked for `parameters:=" + file);
}

TEST(BatchConfiguration, RefusesANoteThatIsNone) {
  const pcrb_test::TemporaryFolder folder;
  std::ofstream(folder.file("batch.txt")) << "hello\n";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, numberOfShards(optionsIn(folder.path())), "`hello`");
}

TEST(ReservedPort, IsGivenToNobodyElse) {
  const ReservedPort a;
  const ReservedPort b;
  EXPECT_NE(a.number(), b.number());
  EXPECT_GT(a.number(), 0);
}

}  // namespace
}  // namespace pcrb_tools
