#include "pcrb_core/run/run_record.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/expect_error.hpp"

namespace pcrb {
namespace {

/// A run folder that sessions of a server open one after the other.
class RunRecordTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "pcrb_XXXXXX";
    run_ = mkdtemp(name.data());
  }
  void TearDown() override { std::filesystem::remove_all(run_); }

  /// A session in which a client answers one problem.
  void play(const std::string& client, const std::string& client_parameters = "") {
    RunRecord record(run_, configuration_, RunPlan());
    record.noteClient(client, client_parameters);
    Result result;
    result.key = {"data", "sequence", Kind::kLocal, std::to_string(++problems_)};
    record.add(result);
  }

  void expectRefusal(const std::string& client, const std::string& client_parameters,
                     const std::string& reason) {
    try {
      play(client, client_parameters);
      ADD_FAILURE() << "a session of " << client << " was let in";
    } catch (const StoreError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }

  std::map<std::string, std::string> info() const {
    return ResultsStore(run_, ResultsStore::Access::kReadOnly).runInfo();
  }

  std::string run_;
  RunConfiguration configuration_;
  int problems_ = 0;
};

TEST_F(RunRecordTest, GoesOnWithTheClientThatTheResultsAreFromAlone) {
  play("/alpha", "[method:icp]");
  expectRefusal("/beta", "[method:icp]", "\n  client: the run has `/alpha`, asked for `/beta`");
  expectRefusal("/alpha", "[method:gicp]",
                "\n  client_parameters: the run has `[method:icp]`, asked for `[method:gicp]`");
  expectRefusal("/alpha", "", "the run has `[method:icp]`, asked for ``");
  play("/alpha", "[method:icp]");
  EXPECT_EQ(info().at("client"), "/alpha");
  EXPECT_EQ(info().at("client_parameters"), "[method:icp]");
}

TEST_F(RunRecordTest, NamesOnlyTheParametersThatDiffer) {
  play("/alpha", "leaf: 0.1\nmethod: icp\nnode program a/b: 12ab\n");
  expectRefusal(
      "/alpha", "leaf: 0.1\nmethod: gicp\nnode program a/b: 34cd\n",
      "\n  client_parameters: the run has `method: icp, node program a/b: 12ab`, asked for "
      "`method: gicp, node program a/b: 34cd`");
}

TEST_F(RunRecordTest, RecordsThatAClientHasNoParameters) {
  play("/alpha");
  EXPECT_EQ(info().at("client_parameters"), "");
  expectRefusal("/alpha", "[method:icp]", "the run has ``, asked for `[method:icp]`");
}

TEST_F(RunRecordTest, ForgetsAClientThatAnsweredNothing) {
  RunRecord(run_, configuration_, RunPlan()).noteClient("/alpha", "[method:icp]");
  play("/beta");
  EXPECT_EQ(info().at("client"), "/beta");
  EXPECT_EQ(info().at("client_parameters"), "");
}

TEST_F(RunRecordTest, RecordsAllNamesOfClientsWhereWhatIsBenchmarkedHasAName) {
  configuration_.under_test = "icp";
  for (const char* name : {"/node_1", "/node_12", "/node_1"}) play(name, "[method:icp]");
  EXPECT_EQ(info().at("client"), "/node_1 /node_12");
  expectRefusal("/node_3", "[method:gicp]", "client_parameters: the run has");
}

TEST_F(RunRecordTest, CallsAProblemByAnotherIdInEachSession) {
  PlannedProblem planned;
  planned.key = {"data", "sequence", Kind::kLocal, "1"};
  const auto idInASession = [&] {
    return RunRecord(run_, configuration_, RunPlan()).publicId(planned);
  };
  const std::string first = idInASession();
  EXPECT_EQ(first.size(), 32u);
  EXPECT_NE(first, idInASession());
}

TEST_F(RunRecordTest, GoesOnUnderTheSameConfigurationAlone) {
  play("/alpha");
  const RunConfiguration same = configuration_;
  configuration_.time_limit = 5.0;
  configuration_.selection.subset = 3;
  configuration_.presentation.yaw_only = true;
  expectRefusal("/alpha", "", "\n  yaw_only: the run has `false`, asked for `true`");
  expectRefusal("/alpha", "", "\n  time_limit: the run has `10`, asked for `5`");
  expectRefusal("/alpha", "", "\n  subset: the run has `0`, asked for `3`");
  configuration_ = same;
  configuration_.selection.root = "/moved";
  play("/alpha");
  EXPECT_EQ(info().at("problems"), "0");
}

TEST_F(RunRecordTest, TakesAnotherConfigurationAsLongAsItHasNoResultAndKeepsItsSecret) {
  const std::string before = RunRecord(run_, configuration_, RunPlan()).secret().toHex();
  configuration_.time_limit = 5.0;
  EXPECT_EQ(RunRecord(run_, configuration_, RunPlan()).secret().toHex(), before);
  EXPECT_EQ(info().at("time_limit"), "5");
}

TEST_F(RunRecordTest, NamesAProblemFileThatChangedOrIsNotSelected) {
  RunPlan plan;
  plan.problem_files = {{"rooms/hall_local.txt", "1"}, {"rooms/attic_local.txt", "2"}};
  {
    RunRecord record(run_, configuration_, plan);
    Result result;
    result.key = {"rooms", "hall", Kind::kLocal, "1"};
    record.add(result);
  }
  plan.problem_files = {{"rooms/hall_local.txt", "3"}};
  pcrb_test::expectError<StoreError>(
      [&] { RunRecord(run_, configuration_, plan); },
      "problem_file rooms/attic_local.txt: not selected",
      "problem_file rooms/hall_local.txt: the run has `1`, asked for `3`");
}

TEST_F(RunRecordTest, RefusesACloudThatChangedSinceItWasUsed) {
  RunRecord(run_, configuration_, RunPlan()).noteCloud("rooms/hall/a.pcd", "1");
  RunRecord record(run_, configuration_, RunPlan());
  record.noteCloud("rooms/hall/a.pcd", "2");  // no result is of the other one
  pcrb_test::expectError<StoreError>([&] { record.noteCloud("rooms/hall/a.pcd", "1"); },
                                     "cloud rooms/hall/a.pcd: the file has changed");
  EXPECT_EQ(info().at("cloud rooms/hall/a.pcd"), "2");
}

TEST_F(RunRecordTest, AddsUpWhatTheNodeUsed) {
  for (int session = 0; session < 2; ++session) {
    RunRecord record(run_, configuration_, RunPlan());
    record.noteUsage(0.25, 100);
    record.noteUsage(0.0, 50);
    Result result;
    result.key = {"data", "sequence", Kind::kLocal, std::to_string(session)};
    record.add(result);
  }
  EXPECT_EQ(info().at("node_cpu_time_s"), "0.5");
  EXPECT_EQ(info().at("node_peak_memory_bytes"), "100");
}

}  // namespace
}  // namespace pcrb
