#include "common/provenance.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

class ProvenanceTest : public testing::Test {
 protected:
  ProvenanceTest() { provenance_.setParameter("seed", "1"); }

  pcrb_test::TemporaryFolder folder_;
  std::string output_ = folder_.file("plain_local.txt");
  Provenance provenance_{"sample_problems"};
};

TEST_F(ProvenanceTest, AnOutputThatWasRecordedIsUpToDateAndReplaceable) {
  provenance_.begin(output_);
  pcrb_test::writeFile(output_, "problems");
  provenance_.record(output_);
  EXPECT_TRUE(provenance_.isUpToDate(output_));
  EXPECT_NO_THROW(Provenance::requireReplaceable(output_));
  provenance_.setParameter("kind", "local");
  EXPECT_FALSE(provenance_.isUpToDate(output_));
}

TEST_F(ProvenanceTest, AnInputOfTheSameSizeButAnotherTimeIsAnotherOneEvenIfItIsOlder) {
  const std::string input = folder_.file("scan.pcd");
  pcrb_test::writeFile(input, "one");
  const auto with_input = [&] {
    Provenance provenance = provenance_;
    provenance.addInput(input);
    return provenance;
  };
  pcrb_test::writeFile(output_, "problems");
  with_input().record(output_);
  EXPECT_TRUE(with_input().isUpToDate(output_));
  const std::string text = with_input().text();
  const auto written = fs::last_write_time(input);
  pcrb_test::writeFile(input, "two");
  fs::last_write_time(input, written - std::chrono::hours(1));
  EXPECT_FALSE(with_input().isUpToDate(output_));
  EXPECT_NE(with_input().text(), text);
  fs::last_write_time(input, written);
  EXPECT_TRUE(with_input().isUpToDate(output_));
}

TEST_F(ProvenanceTest, AKillBeforeTheRecordLeavesSomethingThatIsMadeAgain) {
  provenance_.begin(output_);
  EXPECT_FALSE(provenance_.isUpToDate(output_));
  EXPECT_NO_THROW(Provenance::requireReplaceable(output_));
  EXPECT_FALSE(provenance_.isBegun(output_)) << "there is none yet";
  pcrb_test::writeFile(output_, "problems");
  EXPECT_FALSE(provenance_.isUpToDate(output_));
  EXPECT_NO_THROW(Provenance::requireReplaceable(output_));
  EXPECT_TRUE(provenance_.isBegun(output_));
  provenance_.setParameter("kind", "local");
  EXPECT_FALSE(provenance_.isBegun(output_));
}

TEST_F(ProvenanceTest, TheNextRunClearsWhatAKilledOneHasLeft) {
  pcrb_test::writeFile(folder_.file(".plain_local.txt.4711-0.tmp"), "prob");
  pcrb_test::writeFile(folder_.file(".plain_local.txt.yaml.4711-1.tmp"), "too");
  pcrb_test::writeFile(folder_.file(".plain_global.txt.4712-0.tmp"), "another's");
  provenance_.begin(output_);
  EXPECT_EQ(pcrb_test::namesIn(folder_.path()),
            (std::vector<std::string>{".plain_global.txt.4712-0.tmp", "plain_local.txt.yaml"}));
}

TEST_F(ProvenanceTest, WhatSomebodyElseMadeOrChangedIsNotReplaced) {
  pcrb_test::writeFile(output_, "published problems");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, Provenance::requireReplaceable(output_), "not made by");
  provenance_.record(output_);
  pcrb_test::writeFile(output_, "edited problems");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, Provenance::requireReplaceable(output_), "was changed");
}

}  // namespace
}  // namespace pcrb_tools
