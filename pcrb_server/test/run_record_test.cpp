#include "server/run_record.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace pcrb {
namespace {

/// A run folder that sessions of a server open one after the other.
class RunRecordTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "pcrb_XXXXXX";
    parameters_.run = mkdtemp(name.data());
  }
  void TearDown() override { std::filesystem::remove_all(parameters_.run); }

  /// A session in which a client answers one problem.
  void play(const std::string& client, const std::string& client_parameters = "") {
    RunRecord record(parameters_, RunPlan());
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
    return ResultsStore(parameters_.run, ResultsStore::Access::kReadOnly).runInfo();
  }

  ServerParameters parameters_;
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

TEST_F(RunRecordTest, RecordsThatAClientHasNoParameters) {
  play("/alpha");
  EXPECT_EQ(info().at("client_parameters"), "");
  expectRefusal("/alpha", "[method:icp]", "the run has ``, asked for `[method:icp]`");
}

TEST_F(RunRecordTest, ForgetsAClientThatAnsweredNothing) {
  RunRecord(parameters_, RunPlan()).noteClient("/alpha", "[method:icp]");
  play("/beta");
  EXPECT_EQ(info().at("client"), "/beta");
  EXPECT_EQ(info().at("client_parameters"), "");
}

TEST_F(RunRecordTest, RecordsAllNamesOfClientsWhereWhatIsBenchmarkedHasAName) {
  parameters_.under_test = "icp";
  for (const char* name : {"/node_1", "/node_12", "/node_1"}) play(name, "[method:icp]");
  EXPECT_EQ(info().at("client"), "/node_1 /node_12");
  expectRefusal("/node_3", "[method:gicp]", "client_parameters: the run has");
}

TEST_F(RunRecordTest, CallsAProblemByAnotherIdInEachSession) {
  PlannedProblem planned;
  planned.key = {"data", "sequence", Kind::kLocal, "1"};
  const auto idInASession = [&] { return RunRecord(parameters_, RunPlan()).publicId(planned); };
  const std::string first = idInASession();
  EXPECT_EQ(first.size(), 32u);
  EXPECT_NE(first, idInASession());
}

}  // namespace
}  // namespace pcrb
