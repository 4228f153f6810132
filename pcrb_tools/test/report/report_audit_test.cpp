#include "support/report_fixture.hpp"

namespace pcrb_tools {
namespace {

using ErrorOfPlace = double (*)(std::size_t pair, std::size_t place);

/// Runs whose problems are posed pair by pair, and what the report says of memory.
class ReportAuditTest : public ReportTest {
 protected:
  /// 20 pairs with six problems each, the error of each by its pair and its place in the order.
  void addPosedRun(const std::string& name, ErrorOfPlace errorOf,
                   const std::map<std::string, std::string>& info = {}) {
    const std::string path = folder_.file(name);
    pcrb::ResultsStore store(path, pcrb::ResultsStore::Access::kReadWrite);
    std::map<std::string, std::string> run{{"secret", "0123456789abcdef0123456789abcdef"},
                                           {"client", "/node"},
                                           {"under_test", "mine"}};
    for (const auto& [key, value] : info) run[key] = value;
    store.setRunInfo(run);
    for (std::size_t i = 0; i < 120; ++i) {
      pcrb::Result result = pcrb_test::fullResult("421552847" + std::to_string(1000 + i));
      result.source = "scan" + std::to_string(i / 6) + ".pcd";
      result.finished = 1e9 - static_cast<double>(i);  // the id with the highest number first
      result.error = errorOf(i / 6, 5 - i % 6);
      store.add(result);
    }
    options_.runs.push_back(path);
  }

  Rows audit() {
    writeReportData(options_);
    return readCsv(options_.output + "/tables/local_audit.csv");
  }
};

/// No better on later problems than on the first one.
double honest(std::size_t pair, std::size_t place) {
  return 0.1 + 0.01 * static_cast<double>((7 * pair + 3 * place) % 6);
}

double reusing(std::size_t pair, std::size_t place) {
  return place == 0 ? 0.5 : honest(pair, place);
}

double remembering(std::size_t pair, std::size_t place) { return 1e-6 * honest(pair, place); }

double noisier(std::size_t pair, std::size_t place) { return 1.02 * honest(pair, place); }

TEST_F(ReportAuditTest, FindsAMethodConsistentThatDoesNotProfitFromEarlierProblems) {
  addPosedRun("honest", honest);
  const Rows rows = audit();
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("verdict"), "consistent");
  EXPECT_EQ(rows[0].at("problems"), "120");
  EXPECT_EQ(rows[0].at("pairs"), "20");
}

TEST_F(ReportAuditTest, ReportsAMethodThatSolvesAPairOnceAndUsesItAgain) {
  addPosedRun("reusing", reusing);
  EXPECT_EQ(audit()[0].at("verdict"),
            "gains by memory: 0.500 on a pair's first problem, 0.130 on later ones");
}

TEST_F(ReportAuditTest, ReportsAMethodWhosePlainRunIsBetterThanItsAuditedOne) {
  addPosedRun("plain", remembering);
  addPosedRun("audited", honest, {{"audit", "true"}});
  addPosedRun("other", remembering, {{"under_test", "other"}});  // without an audited run
  const Rows rows = audit();
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[1].at("compared"), "run without an audit, audited");
  EXPECT_EQ(rows[1].at("verdict"), "gains by memory: 1.25e-07 without an audit, 0.125 with one");
}

TEST_F(ReportAuditTest, TakesTheLossOfPointsInAnAuditForNoGainOfMemory) {
  addPosedRun("plain", honest);
  addPosedRun("audited", noisier, {{"audit", "true"}});
  const Rows rows = audit();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].at("verdict"), "consistent");
}

TEST_F(ReportAuditTest, SaysNothingOfRunsWithoutAClient) {
  options_.runs = {addRun("imported", 0.2)};
  writeReportData(options_);
  EXPECT_FALSE(std::ifstream(options_.output + "/tables/local_audit.csv").good());
}

}  // namespace
}  // namespace pcrb_tools
