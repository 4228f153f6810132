#include "ground_truth/ground_truth_tool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "conversion/converters.hpp"
#include "ground_truth/pair_evaluation.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "report/details.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/sample_log_support.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using pcrb_test::readText;

TEST(GroundTruthTool, GivesThePapersTable1FromThePublishedMisalignments) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string data = pcrb_test::sharedData() + "/ground_truth_check/";
  const pcrb_test::TemporaryFolder folder;
  GroundTruthOptions options;
  options.output = folder.path();
  options.imports = {"eth=" + data + "apartment.csv", "eth=" + data + "gazebo_winter.csv",
                     "planetary=" + data + "p2at_met.csv", "tum=" + data + "pioneer_slam.csv",
                     "kaist=" + data + "urban05.csv"};
  std::ostringstream out;
  runGroundTruthTool(options, out);
  const std::string text = out.str();
  EXPECT_NE(text.find("eth: 0.05 ± 0.02 m (gazebo_winter)\n"
                      "planetary: 0.13 ± 0.05 m (p2at_met)\n"
                      "tum: 0.11 ± 0.09 m (pioneer_slam)\n"
                      "kaist: 0.04 ± 0.03 m (urban05)\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(readText(folder.file("ground_truth.txt")), text);
}

TEST(GroundTruthTool, DrawsThePapersFigure2WithItsNumbers) {
  PCRB_REQUIRE_SHARED_DATA();
  const pcrb_test::TemporaryFolder folder;
  GroundTruthOptions options;
  options.output = folder.path();
  options.imports = {"eth=" + pcrb_test::sharedData() + "/ground_truth_check/apartment.csv"};
  std::ostringstream out;
  runGroundTruthTool(options, out);
  const std::string svg = readText(folder.file("ground_truth_pairs.svg"));
  // numpy's mean and std of norms of translations, and of angles, of that file's rows
  EXPECT_NE(svg.find("translation (m): 0.064 ± 0.034"), std::string::npos);
  EXPECT_NE(svg.find("rotation (°): 0.957 ± 0.497"), std::string::npos);
  EXPECT_NE(svg.find("misalignment (m): "), std::string::npos);
  EXPECT_NE(svg.find("100 pairs"), std::string::npos);
  std::size_t dots = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    ++dots;
  }
  EXPECT_GT(dots, 380u);
  EXPECT_LE(dots, 400u);
}

/// Sample logs of one sequence whose ground truth is wrong by a known length, converted, with all
/// ordered pairs of clouds as problems.
class WrongGroundTruth : public ::testing::Test {
 protected:
  static constexpr double kError = 0.04;  // m

  explicit WrongGroundTruth(std::uint64_t seed = 1) {
    simulation::LogOptions logs;
    logs.seed = seed;
    logs.size = {3, 80, 130, 0, 0, 0, 0, 1, 0, 0, 0};
    logs.ground_truth_error = kError;
    simulation::LogPlan plan = planEthLogs(logs);
    const auto is_other = [](const auto& file) { return file.find("apartment") == file.npos; };
    plan.jobs.erase(std::remove_if(plan.jobs.begin(), plan.jobs.end(),
                                   [&](const auto& job) { return is_other(job.files.front()); }),
                    plan.jobs.end());
    pcrb_test::makeLogs(plan, folder_.path());
    for (const auto& known : plan.errors) {
      if (known.sequence == "apartment") errors_[known.cloud] = known.error;
    }
    convert();
    writeProblems();
    options_.root = folder_.file("root");
    options_.output = folder_.file("out");
    options_.threads = 2;
  }

  void convert() {
    EthRequest request;
    request.inputs = {folder_.file("eth/apartment")};
    request.root = folder_.file("root");
    request.sequence = "apartment";
    convertEth(request);
  }

  void writeProblems() {
    std::vector<pcrb::Problem> problems;
    for (const auto& [source, source_error] : errors_) {
      for (const auto& [target, target_error] : errors_) {
        if (source == target) continue;
        pcrb::Problem problem{std::to_string(1000 + problems.size()), source, target, 0.5, {}};
        problem.perturbation.setIdentity();
        problems.push_back(problem);
        expected_.push_back((source_error - target_error).norm());
      }
    }
    pcrb::writeProblemFile(folder_.file("root/eth/apartment_local.txt"), problems);
  }

  std::string run() {
    std::ostringstream out;
    runGroundTruthTool(options_, out);
    return out.str();
  }

  pcrb_test::TemporaryFolder folder_;
  GroundTruthOptions options_;
  std::map<std::string, Eigen::Vector3d> errors_;  // m, by cloud
  std::vector<double> expected_;                   // m, misalignment of each pair
};

/// The same with logs of other worlds and errors.
class WrongGroundTruthOfAnySeed : public WrongGroundTruth,
                                  public ::testing::WithParamInterface<std::uint64_t> {
 protected:
  WrongGroundTruthOfAnySeed() : WrongGroundTruth(GetParam()) {}
};

INSTANTIATE_TEST_SUITE_P(Seeds, WrongGroundTruthOfAnySeed, ::testing::Values(1, 2, 3, 4));

TEST_P(WrongGroundTruthOfAnySeed, IsFoundWithItsSize) {
  run();
  const PairFile found = readPairFile(options_.output + "/pairs/eth_apartment.csv");
  ASSERT_EQ(found.misalignments.size(), expected_.size());
  const auto is = pcrb::assessGroundTruth(found.misalignments).kept;
  const auto should_be = pcrb::assessGroundTruth(expected_).kept;
  EXPECT_NEAR(is.mean, should_be.mean, 0.2 * should_be.mean);
}

TEST_F(WrongGroundTruth, IsEvaluatedOnceAndGoesOnFromItsLastPair) {
  options_.max_pairs = 3;
  const std::string text = run();
  const std::string pairs = options_.output + "/pairs/eth_apartment.csv";
  const std::string complete = readText(pairs);
  EXPECT_EQ(readPairFile(pairs).pairs(), 3U);

  const auto written = fs::last_write_time(pairs);
  EXPECT_EQ(run(), text);
  EXPECT_EQ(fs::last_write_time(pairs), written) << "evaluated again";

  // What a kill after the first pair leaves; the remark tells that row from one made anew.
  const std::string partial = pairs + ".partial";
  const std::size_t first_row = complete.find('\n', complete.find('\n') + 1);
  const std::string kept = complete.substr(0, first_row) + "kept";
  const std::string side = readText(pairs + ".yaml");
  fs::remove(pairs);
  fs::remove(pairs + ".yaml");
  pcrb::writeFileAtomically(partial, kept + "\n");
  pcrb::writeFileAtomically(partial + ".yaml",
                            side.substr(0, side.find("output_blake2b")) + "unfinished: true\n");
  EXPECT_EQ(run(), text);
  EXPECT_EQ(readText(pairs), kept + complete.substr(first_row));
  EXPECT_FALSE(fs::exists(partial) || fs::exists(partial + ".yaml"));

  // What a kill of a run with another radius leaves.
  fs::remove(pairs);
  fs::remove(pairs + ".yaml");
  pcrb::writeFileAtomically(partial, kept + "\n");
  pcrb::writeFileAtomically(partial + ".yaml", "unfinished: true\n");
  EXPECT_EQ(run(), text);
  EXPECT_EQ(readText(pairs), complete);
}

TEST_F(WrongGroundTruth, OfPairsThatCannotBeAlignedIsUnknownAndStopsNoOther) {
  const std::string few =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n"
      "HEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n";
  pcrb_test::writeFile(folder_.file("root/eth/apartment/few.pcd"), few);
  pcrb_test::writeFile(folder_.file("root/eth/hut/few.pcd"), few);
  const auto problem = [](const std::string& id, const std::string& source,
                          const std::string& target) {
    return pcrb::Problem{id, source, target, 0.5, Eigen::Matrix<double, 3, 4>::Identity()};
  };
  const std::string a = errors_.begin()->first, b = errors_.rbegin()->first;
  pcrb::writeProblemFile(
      folder_.file("root/eth/apartment_local.txt"),
      {problem("11", "few.pcd", a), problem("12", b, a), problem("13", a, "few.pcd")});
  pcrb::writeProblemFile(folder_.file("root/eth/hut_local.txt"),
                         {problem("14", "few.pcd", "few.pcd")});
  const std::string text = run();
  EXPECT_NE(text.find("eth/hut: no pair aligned"), std::string::npos) << text;
  EXPECT_NE(text.find(" m (apartment)"), std::string::npos) << text;
  const std::string pairs = readText(options_.output + "/pairs/eth_apartment.csv");
  EXPECT_EQ(readPairFile(options_.output + "/pairs/eth_apartment.csv").failed, 2U);
  EXPECT_NE(pairs.find(",,,,,,,,few.pcd," + a + ",\"source: found 2 points"), std::string::npos)
      << pairs;
  const std::string csv = options_.output + "/ground_truth.csv";
  EXPECT_NE(readText(csv).find("eth,hut,1,1,0,,,,0,,,,\n"), std::string::npos) << readText(csv);
  const auto floors = readGroundTruth(csv);
  ASSERT_EQ(floors.size(), 1U);
  EXPECT_EQ(floors.front().sequence, "apartment");

  for (const std::string name : {"eth/hut", "hut"}) {
    options_.sequences = {name};
    PCRB_EXPECT_ERROR(pcrb::InvalidProblem, run(), "no pair that could be aligned");
  }
}

TEST(GroundTruthTool, RefusesAFileThatItDidNotMake) {
  const pcrb_test::TemporaryFolder folder;
  pcrb::writeFileAtomically(folder.file("some.csv"), "error\n0.1\n");
  GroundTruthOptions options;
  options.output = folder.file("out");
  std::ostringstream out;
  options.imports = {"eth=" + folder.file("some.csv")};
  pcrb_test::expectError<pcrb::InvalidFile>([&] { runGroundTruthTool(options, out); }, "some.csv:1",
                                            "found 'error'", "misalignment_m");
  options.imports = {folder.file("some.csv")};
  EXPECT_THROW(runGroundTruthTool(options, out), pcrb::InvalidParameter);
  options.imports.clear();
  EXPECT_THROW(runGroundTruthTool(options, out), pcrb::InvalidParameter);
  EXPECT_FALSE(fs::exists(options.output));
}

TEST(PairFile, RefusesARowThatIsNotFullOfNumbers) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("plain.csv");
  const auto expect_refusal = [&](const std::string& row, const std::string& found) {
    pcrb::writeFileAtomically(path, "misalignment_m,tx,ty,tz,qx,qy,qz,qw\n" + row + "\n");
    pcrb_test::expectError<pcrb::InvalidFile>([&] { readPairFile(path); }, "plain.csv:2", found);
  };
  expect_refusal("0.1,0,0,0,0,0,0", "7 fields");
  expect_refusal("-0.1,0,0,0,0,0,0,1", "'-0.1'");
  expect_refusal("nan,0,0,0,0,0,0,1", "'nan'");
  expect_refusal("0.1,0,0,,0,0,0,1", "''");
}

TEST(PairFile, KeepsWhatFailedApart) {
  const pcrb_test::TemporaryFolder folder;
  PairFile file = emptyPairFile();
  addAligned(file, {"a,b.pcd", "c.pcd"}, 0.25, pcrb::Transform::Identity(), "");
  addFailed(file, {"c.pcd", "d.pcd"}, "found no \"pair\"");
  pcrb::writeFileAtomically(folder.file("pairs.csv"), file.text);
  const PairFile read = readPairFile(folder.file("pairs.csv"));
  EXPECT_EQ(read.misalignments, std::vector<double>{0.25});
  EXPECT_EQ(read.failed, 1U);
  EXPECT_EQ(read.text, file.text);
}

}  // namespace
}  // namespace pcrb_tools
