#include "simulation/sample_logs.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "pcrb_core/error.hpp"
#include "support/sample_log_support.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools::simulation {
namespace {

using pcrb_test::makeLogs;
using pcrb_test::readTree;
using pcrb_test::TemporaryFolder;
using pcrb_test::tinyLogs;

LogPlan planAll(const LogOptions& options) {
  LogPlan all;
  for (const auto planner : {planEthLogs, planPlanetaryLogs, planTumLogs, planKaistLogs}) {
    LogPlan plan = planner(options);
    all.jobs.insert(all.jobs.end(), plan.jobs.begin(), plan.jobs.end());
    all.errors.insert(all.errors.end(), plan.errors.begin(), plan.errors.end());
  }
  return all;
}

TEST(SampleLogs, SameSeedGivesTheSameBytesAtAnyNumberOfThreads) {
  TemporaryFolder one;
  TemporaryFolder five;
  LogOptions options = tinyLogs();
  makeLogs(planAll(options), one.path(), 1);
  options.threads = 3;
  makeLogs(planAll(options), five.path(), 5);
  const auto expected = readTree(one.path());
  EXPECT_EQ(expected.size(), 2U * (2 * 2 + 1) + 2U * 2 * 2 + 4U + 6U + 5U);
  EXPECT_TRUE(expected == readTree(five.path()));
}

TEST(SampleLogs, AnotherSeedGivesOtherPoints) {
  TemporaryFolder one;
  TemporaryFolder other;
  LogOptions options = tinyLogs();
  makeLogs(planPlanetaryLogs(options), one.path());
  options.seed = 2;
  makeLogs(planPlanetaryLogs(options), other.path());
  const auto first = readTree(one.path());
  const auto second = readTree(other.path());
  for (const auto& [name, bytes] : first) EXPECT_NE(bytes, second.at(name)) << name;
}

TEST(SampleLogs, EveryJobMakesTheFilesThatItNames) {
  TemporaryFolder folder;
  for (const LogJob& job : planAll(tinyLogs()).jobs) {
    for (const std::string& file : job.files)
      EXPECT_FALSE(std::filesystem::exists(folder.file(file)));
    job.make(folder.path());
    for (const std::string& file : job.files)
      EXPECT_TRUE(std::filesystem::exists(folder.file(file)));
  }
}

SampleLogsRequest requestIn(const TemporaryFolder& folder) {
  SampleLogsRequest request;
  request.output = folder.file("logs");
  request.data_sets = {"kaist"};
  return request;
}

TEST(SampleLogs, SecondCallMakesWhatIsMissingAndKeepsTheRest) {
  TemporaryFolder folder;
  const SampleLogsRequest request = requestIn(folder);
  makeSampleLogs(request);
  const auto made = readTree(request.output);
  const std::filesystem::path poses =
      std::filesystem::path(request.output) / "kaist/urban05/global_pose.csv";
  const std::filesystem::path kept =
      std::filesystem::path(request.output) / "kaist/urban05/calibration/Vehicle2LeftVLP.txt";
  std::filesystem::remove(poses);
  std::ofstream(kept) << "not touched";
  makeSampleLogs(request);
  EXPECT_EQ(pcrb_test::readText(poses), made.at("kaist/urban05/global_pose.csv"));
  EXPECT_EQ(pcrb_test::readText(kept), "not touched");
}

TEST(SampleLogs, RefusesAFolderWithLogsOfAnotherSeed) {
  TemporaryFolder folder;
  SampleLogsRequest request = requestIn(folder);
  makeSampleLogs(request);
  request.seed = 2;
  EXPECT_THROW(makeSampleLogs(request), pcrb::InvalidFile);
}

TEST(SampleLogs, RefusesAFolderWithOtherContents) {
  TemporaryFolder folder;
  SampleLogsRequest request = requestIn(folder);
  request.output = folder.path();
  std::ofstream(folder.file("real.bag")) << "real";
  EXPECT_THROW(makeSampleLogs(request), pcrb::InvalidFile);
  EXPECT_EQ(readTree(folder.path()).size(), 1U);
}

TEST(SampleLogs, RefusesUnknownSizesAndDataSetsAndNegativeErrors) {
  TemporaryFolder folder;
  for (const auto& spoil :
       {+[](SampleLogsRequest& request) { request.size = "huge"; },
        +[](SampleLogsRequest& request) { request.data_sets = {"kitti"}; },
        +[](SampleLogsRequest& request) { request.ground_truth_error = -0.1; }}) {
    SampleLogsRequest request = requestIn(folder);
    spoil(request);
    EXPECT_THROW(makeSampleLogs(request), pcrb::InvalidParameter);
    EXPECT_FALSE(std::filesystem::exists(request.output));
  }
}

TEST(SampleLogs, GroundTruthErrorMovesEveryPoseByItsLengthAndIsListed) {
  TemporaryFolder folder;
  SampleLogsRequest request = requestIn(folder);
  request.data_sets = {"planetary"};
  makeSampleLogs(request);
  SampleLogsRequest wrong = request;
  wrong.output = folder.file("wrong");
  wrong.ground_truth_error = 0.25;
  makeSampleLogs(wrong);

  const auto truth = readTree(request.output);
  const auto found = readTree(wrong.output);
  const auto listed = pcrb_test::readLines(wrong.output + "/ground_truth_error.csv");
  EXPECT_EQ(listed.size(), 1U + 2U * 8U);
  EXPECT_EQ(listed.at(0), "data_set,sequence,cloud,x,y,z");
  for (std::size_t row = 1; row < listed.size(); ++row) {
    const std::string sequence = listed[row].substr(10, listed[row].find(',', 10) - 10);
    const std::size_t cloud = listed[row].find(',', 10) + 1;
    const std::string name = listed[row].substr(cloud, listed[row].find(".pcd") - cloud);
    const auto error = pcrb_test::numbersOf(listed[row].substr(listed[row].find(".pcd,") + 5));
    ASSERT_EQ(error.size(), 3U);
    EXPECT_NEAR(Eigen::Vector3d(error[0], error[1], error[2]).norm(), 0.25, 1e-5);
    const std::string path = "planetary/" + sequence + "/" + name + "/" + name;
    EXPECT_EQ(truth.at(path + ".xyz"), found.at(path + ".xyz")) << "the scans stay as they are";
    const auto right_pose = pcrb_test::numbersOf(truth.at(path + ".gt"));
    const auto wrong_pose = pcrb_test::numbersOf(found.at(path + ".gt"));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(wrong_pose[4 * i + 3] - right_pose[4 * i + 3], error[i], 3e-6);
      EXPECT_EQ(wrong_pose[4 * i], right_pose[4 * i]);
    }
  }
}

}  // namespace
}  // namespace pcrb_tools::simulation
