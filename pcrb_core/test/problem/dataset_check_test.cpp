#include "pcrb_core/problem/dataset_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/overlap.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "problem/frame_offset.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

namespace fs = std::filesystem;

std::string textOf(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text +=
        std::string(toString(finding.severity)) + ": " + finding.file + ": " + finding.what + "\n";
  }
  return text;
}

bool contains(const std::vector<Finding>& findings, const std::string& part) {
  return textOf(findings).find(part) != std::string::npos;
}

std::size_t count(const std::vector<Finding>& findings, Severity severity) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [&](const Finding& finding) { return finding.severity == severity; }));
}

/// Four overlapping clouds with viewpoints in `<root>/eth/plain`, and a local list of them.
class DatasetCheckTest : public ::testing::Test {
 protected:
  DatasetCheckTest() {
    fs::create_directories(folder_.file("eth/plain"));
    files_ = {"eth", "plain", Kind::kLocal, folder_.file("eth/plain_local.txt"),
              folder_.file("eth/plain")};
    dataset_ = loadDataset(folder_.path(), "eth");
    for (int i = 0; i < 4; ++i) writeCloud(i, Eigen::Vector3d::Zero());
    for (int i = 0; i < 3; ++i) {
      list_.pairs.push_back({name(i), name(i + 1), computeOverlap(cloud(i), cloud(i + 1), 0.1)});
    }
    writeList();
  }

  static std::string name(int i) { return "PointCloud" + std::to_string(i) + ".pcd"; }

  DatasetCloud cloud(int i) const { return readPcd(files_.cloud_folder + "/" + name(i)); }

  void writeCloud(int i, const Eigen::Vector3d& shift) {
    DatasetCloud cloud;
    Random random(static_cast<std::uint64_t>(i));
    for (int p = 0; p < 2000; ++p) {
      cloud.points.emplace_back(
          shift + Eigen::Vector3d(0.1 * i + random.uniform(0, 2), random.uniform(0, 2), 0));
    }
    cloud.viewpoint.translation() = shift + Eigen::Vector3d(1, 1, 1);
    writePcd(files_.cloud_folder + "/" + name(i), cloud);
  }

  void writeList() {
    writeProblemFile(files_.problem_file, sampleProblems(list_, 1, [&](const std::string& source) {
                       return centroid(readPcd(files_.cloud_folder + "/" + source));
                     }));
  }

  std::vector<Finding> check() {
    CloudSummaries summaries;
    std::vector<Finding> findings = checkClouds(files_.cloud_folder, 2, summaries);
    for (const auto& some : {checkProblems(files_, dataset_, summaries),
                             checkOverlaps(files_, dataset_, summaries, 10)}) {
      findings.insert(findings.end(), some.begin(), some.end());
    }
    return findings;
  }

  pcrb_test::TemporaryFolder folder_;
  SequenceFiles files_;
  Dataset dataset_;
  ProblemList list_{"plain", Kind::kLocal, {}, {{0, 1}, {0, 30}}};
};

TEST_F(DatasetCheckTest, FindsNothingInASoundSequence) { EXPECT_EQ(textOf(check()), ""); }

TEST_F(DatasetCheckTest, NamesUnreadableAndEmptyCloudsWithTheirLine) {
  fs::resize_file(files_.cloud_folder + "/" + name(2), 1000);
  writePcd(files_.cloud_folder + "/" + name(3), DatasetCloud{});
  CloudSummaries summaries;
  const auto findings = checkClouds(files_.cloud_folder, 2, summaries);
  EXPECT_EQ(count(findings, Severity::kError), 2U) << textOf(findings);
  EXPECT_TRUE(contains(findings, name(2) + ":")) << textOf(findings);
  EXPECT_TRUE(contains(findings, name(3) + ": cloud has no points")) << textOf(findings);
  EXPECT_FALSE(summaries.at(name(2)));
}

TEST_F(DatasetCheckTest, FindsDuplicateCloudsAndMissingViewpoints) {
  fs::copy_file(files_.cloud_folder + "/" + name(1), files_.cloud_folder + "/again.pcd");
  DatasetCloud without = cloud(2);
  without.viewpoint = Transform::Identity();
  writePcd(files_.cloud_folder + "/" + name(2), without);
  const auto findings = check();
  EXPECT_TRUE(contains(findings, "has the same points as ")) << textOf(findings);
  EXPECT_TRUE(contains(findings, "1 of 5 clouds have no VIEWPOINT")) << textOf(findings);
  EXPECT_EQ(count(findings, Severity::kError), 0U);
}

TEST_F(DatasetCheckTest, NamesAbsentClouds) {
  fs::remove(files_.cloud_folder + "/" + name(3));
  EXPECT_TRUE(contains(
      check(), "error: " + files_.problem_file + ": 1 of 4 clouds that it names are not in"))
      << textOf(check());
}

TEST_F(DatasetCheckTest, EstimatesTheOffsetOfCloudsInAnotherFrame) {
  for (int i = 0; i < 4; ++i) writeCloud(i, {50.0, -30.0, 10.0});
  const auto findings = check();
  EXPECT_EQ(count(findings, Severity::kError), 1U) << textOf(findings);
  EXPECT_TRUE(contains(findings, "in another frame than the problem file's")) << textOf(findings);
  EXPECT_TRUE(contains(findings, "one offset of the clouds explains all rows: (-"))
      << textOf(findings);
}

TEST_F(DatasetCheckTest, SaysWhenNoSingleOffsetExplainsTheRows) {
  writeCloud(0, {50.0, -30.0, 10.0});
  const auto findings = check();
  EXPECT_TRUE(contains(findings, "no single offset explains it")) << textOf(findings);
}

TEST_F(DatasetCheckTest, FindsCloudsThatAreTooFarApartToBeServed) {
  writeCloud(1, {2000.0, 0.0, 0.0});
  EXPECT_TRUE(contains(check(), "PointCloud0.pcd and PointCloud1.pcd reach 2001 m"))
      << textOf(check());
}

TEST_F(DatasetCheckTest, WarnsOfOverlapsThatAreOffAsApproximateOnesAre) {
  list_.pairs[1].overlap -= 0.01;
  writeList();
  const auto findings = check();
  EXPECT_EQ(count(findings, Severity::kError), 0U) << textOf(findings);
  EXPECT_TRUE(contains(findings, "warning: " + files_.problem_file +
                                     ": the overlap of 1 of 3 recomputed pairs differs by up to "
                                     "0.01"))
      << textOf(findings);
  EXPECT_TRUE(contains(findings, "PointCloud1.pcd on PointCloud2.pcd")) << textOf(findings);
}

TEST_F(DatasetCheckTest, OverlapsOfOtherCloudsAreAnError) {
  list_.pairs[1].overlap -= 0.01;
  list_.pairs[2].overlap -= 0.06;
  writeList();
  const auto findings = check();
  EXPECT_TRUE(contains(findings, "error: " + files_.problem_file +
                                     ": the overlap of 2 of 3 recomputed pairs differs by up to "
                                     "0.06"))
      << textOf(findings);
}

TEST_F(DatasetCheckTest, FindsRepeatedPairsAndRows) {
  list_.pairs.push_back(list_.pairs[0]);
  writeList();
  EXPECT_TRUE(contains(check(), "note: " + files_.problem_file + ": has 3 different pairs in 4"))
      << textOf(check());
  auto problems = readProblemFile(files_.problem_file);
  problems[100].perturbation = problems[5].perturbation;  // pair 3 is pair 0 again
  writeProblemFile(files_.problem_file, problems);
  EXPECT_TRUE(contains(check(), "1 of 120 rows repeat an earlier one")) << textOf(check());
}

TEST_F(DatasetCheckTest, FindsRowsThatAreNotRigidForeignIdsAndSmallOverlaps) {
  auto problems = readProblemFile(files_.problem_file);
  problems[2].perturbation(0, 0) += 0.01;
  problems[3].id = "1234567890000";
  problems[4].overlap = 0.2;
  writeProblemFile(files_.problem_file, problems);
  const auto findings = check();
  EXPECT_TRUE(contains(findings, "error: " + files_.problem_file + ":4: transform is not rigid"))
      << textOf(findings);
  EXPECT_TRUE(contains(findings, "1 of 90 ids do not begin with 421552847")) << textOf(findings);
  EXPECT_TRUE(contains(findings, "has overlaps from 0.2000, where sampling begins at 0.4"))
      << textOf(findings);
}

TEST_F(DatasetCheckTest, ReportsAMalformedProblemFileWithItsLine) {
  std::ofstream(files_.problem_file, std::ios::app) << "4215528479999 a b\n";
  const auto findings = checkProblems(files_, dataset_, {});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_TRUE(contains(findings, files_.problem_file + ":92: found 3 fields")) << textOf(findings);
}

/// The published problem files, without clouds.
std::vector<Finding> checkPublished(const std::string& data_set, const std::string& sequence,
                                    Kind kind) {
  const std::string file =
      pcrb_test::sharedData() + "/official/" + sequence + "_" + toString(kind) + ".txt";
  return checkProblems({data_set, sequence, kind, file, "clouds"}, loadDataset("/", data_set), {});
}

TEST(PublishedProblemFiles, AreUnderstoodWithTheirPeculiarities) {
  PCRB_REQUIRE_SHARED_DATA();
  const auto plain = checkPublished("eth", "plain", Kind::kLocal);
  EXPECT_EQ(count(plain, Severity::kError), 1U) << textOf(plain);  // no clouds
  EXPECT_TRUE(contains(plain, "31 of 31 clouds that it names are not in clouds")) << textOf(plain);
  const auto map = checkPublished("planetary", "planetary_map", Kind::kLocal);
  EXPECT_TRUE(contains(map, "poses every source against box_map.pcd, with overlaps from 0.07"))
      << textOf(map);
  const auto urban = checkPublished("kaist", "urban05", Kind::kLocal);
  EXPECT_TRUE(contains(
      urban, "expressed in a frame with a far origin; its rows rotate about centroids within"))
      << textOf(urban);
  for (const auto& findings :
       {plain, map, urban, checkPublished("planetary", "p2at_met", Kind::kGlobal)}) {
    EXPECT_EQ(count(findings, Severity::kError), 1U) << textOf(findings);
    EXPECT_EQ(count(findings, Severity::kWarning), 0U) << textOf(findings);
  }
}

/// Clouds at the centroids that urban05's rows rotate about, moved by an offset.
CloudSummaries urbanClouds(const std::vector<Problem>& problems, const Eigen::Vector3d& offset) {
  std::map<std::string, std::vector<PerturbedCentroid>> rows_of;
  for (const Problem& problem : problems) {
    rows_of[problem.source].push_back(
        {requireRigid(problem.perturbation), Eigen::Vector3d::Zero()});
    rows_of[problem.target];
  }
  CloudSummaries summaries;
  for (const auto& [name, rows] : rows_of) {
    CloudSummary summary;
    summary.points = 1;
    if (!rows.empty()) summary.centroid = estimateFrameOffset(rows).offset - offset;
    summary.box.extend(summary.centroid);
    if (!rows.empty()) summaries[name] = summary;
  }
  return summaries;
}

TEST(PublishedProblemFiles, Urban05NeedsAnOffsetForCloudsInSingleUtmAndItIsEstimated) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string file = pcrb_test::sharedData() + "/official/urban05_local.txt";
  const std::vector<Problem> problems = readProblemFile(file);
  const SequenceFiles files{"kaist", "urban05", Kind::kLocal, file, "clouds"};
  const Dataset kaist = loadDataset("/", "kaist");
  const auto published_frame =
      checkProblems(files, kaist, urbanClouds(problems, Eigen::Vector3d::Zero()));
  EXPECT_FALSE(contains(published_frame, "another frame")) << textOf(published_frame);

  const Eigen::Vector3d single_utm(351000.0, 4022500.0, 10.0);
  const auto findings = checkProblems(files, kaist, urbanClouds(problems, single_utm));
  EXPECT_TRUE(contains(findings, "3000 of 3000 rows move the source's centroid too far"))
      << textOf(findings);
  EXPECT_TRUE(contains(findings, "one offset of the clouds explains all rows: (35"))
      << textOf(findings);
  EXPECT_TRUE(contains(findings, "about twice the clouds'")) << textOf(findings);
}

}  // namespace
}  // namespace pcrb
