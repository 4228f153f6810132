#include <gtest/gtest.h>

#include "pcrb_core/run/results_store.hpp"
#include "run/some_results.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

using pcrb_test::fullResult;

class ResultsStoreScansTest : public ::testing::Test {
 protected:
  ResultsStore writer() const {
    return ResultsStore(folder_.file("run"), ResultsStore::Access::kReadWrite);
  }

  pcrb_test::TemporaryFolder folder_;
};

/// A scan without an answer, and one with.
std::vector<ScanRecord> someScans() {
  ScanRecord unanswered;
  unanswered.scan = 1;
  ScanRecord answered;
  answered.scan = 2;
  answered.sent = 0.1;
  answered.answered = 1.0 / 3.0;
  answered.is_echo = true;
  answered.position = Eigen::Vector3d(1e-300, 2.0, -3.5);
  answered.orientation = Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5);
  answered.error = 0.125;
  return {unanswered, answered};
}

TEST_F(ResultsStoreScansTest, KnowsTheSequenceOfItsNewestResult) {
  ResultsStore store = writer();
  EXPECT_EQ(store.newestSequence(), "");
  for (const char* sequence : {"stairs", "apartment"}) {
    Result result = fullResult("1");
    result.key.sequence = sequence;
    result.finished = 1.0 + static_cast<double>(store.count());
    store.add(result);
  }
  EXPECT_EQ(store.newestSequence(), "apartment");
}

TEST_F(ResultsStoreScansTest, KeepsTheScansOfAResultToTheLastBit) {
  Result result = fullResult("1");
  result.scans = someScans();
  ResultsStore store = writer();
  store.add(result);
  store.add(fullResult("2"));
  const auto scans = store.scans();
  ASSERT_EQ(scans.size(), 1u);
  const auto& records = scans.at(result.key);
  ASSERT_EQ(records.size(), 2u);
  EXPECT_FALSE(records[0].answered || records[0].position || records[0].error);
  EXPECT_EQ(records[1].scan, 2u);
  EXPECT_EQ(records[1].sent, 0.1);
  EXPECT_EQ(records[1].answered, 1.0 / 3.0);
  EXPECT_TRUE(records[1].is_echo);
  EXPECT_EQ(*records[1].position, *result.scans[1].position);
  EXPECT_EQ(records[1].orientation->coeffs(), result.scans[1].orientation->coeffs());
  EXPECT_EQ(records[1].error, 0.125);
}

TEST_F(ResultsStoreScansTest, KeepsNoScanOfAResultThatItRefuses) {
  Result result = fullResult("1");
  ResultsStore store = writer();
  store.add(result);
  result.scans = someScans();
  EXPECT_THROW(store.add(result), StoreError);
  EXPECT_TRUE(store.scans().empty());
}

}  // namespace
}  // namespace pcrb
