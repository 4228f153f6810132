#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "support/report_fixture.hpp"

namespace pcrb_tools {
namespace {

/// A data set on the disk with a run on it. All points are 2 m from the centroid, so that the
/// metric of a translation by 1 m is 0.5. Most replies are off by some mm along x, four by 2 m.
class ReportFloorTest : public ReportTest {
 protected:
  void SetUp() override {
    ReportTest::SetUp();
    std::filesystem::create_directories(folder_.file("root/own/yard"));
    pcrb::DatasetCloud cloud;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-2.0, 2.0}) {
        cloud.points.push_back(side * Eigen::Vector3d::Unit(axis));
      }
    }
    for (const char* name : {"a", "b"}) {
      pcrb::writePcd(folder_.file("root/own/yard/" + std::string(name) + ".pcd"), cloud);
    }
    const auto P = pcrb::makePerturbation(Eigen::Vector3d::Zero(), {0.5, -0.2, 0.1},
                                          Eigen::Matrix3d::Identity());
    std::vector<pcrb::Problem> problems;
    pcrb::ResultsStore store(folder_.file("run"), pcrb::ResultsStore::Access::kReadWrite);
    store.setRunInfo({{"root", folder_.file("root")}, {"presentation", "registration"}});
    for (int i = -10; i <= 10; ++i) {
      problems.push_back({std::to_string(50 + i), "a.pcd", "b.pcd", 0.5, {}});
      problems.back().perturbation = P.matrix().topRows<3>();
      const double x = std::abs(i) < 9 ? 0.001 * i : i < 0 ? -2.0 : 2.0;
      store.add(resultOf(problems.back().id, x, P));
    }
    pcrb::writeProblemFile(folder_.file("root/own/yard_local.txt"), problems);
    options_.runs = {folder_.file("run")};
    options_.ground_truth = addFile("truth.csv", kHeader + "own,yard,0.05,0.02\n");
  }

  static pcrb::Result resultOf(const std::string& id, double x, const pcrb::Transform& P) {
    pcrb::Result result = pcrb_test::minimalResult(id);
    result.key.data_set = "own";
    result.key.sequence = "yard";
    result.outcome = pcrb::Outcome::kReplied;
    result.translation_error = std::abs(x);
    result.rotation_error = 0.0;
    result.position = Eigen::Vector3d(x, 0.0, 0.0) - P.translation();
    result.orientation = Eigen::Quaterniond::Identity();
    return result;
  }

  /// The one row of the report's table, and what the report said on standard error.
  std::map<std::string, std::string> floorRow() {
    testing::internal::CaptureStderr();
    writeReportData(options_);
    said_ = testing::internal::GetCapturedStderr();
    return readCsv(options_.output + "/tables/local_ground_truth.csv").at(0);
  }

  const std::string kHeader = "data_set,sequence,mean,stddev\n";
  std::string said_;
};

TEST_F(ReportFloorTest, IsTheErrorOfATranslationByTheMean) {
  EXPECT_NEAR(*pcrb::parseDouble(floorRow().at("floor")), 0.05 * 0.5, 1e-9);
}

TEST_F(ReportFloorTest, IsThereWithoutTheErrorsAlongEachAxisAndDrawn) {
  options_.with_components = false;
  EXPECT_NEAR(*pcrb::parseDouble(floorRow().at("floor")), 0.025, 1e-9);
  EXPECT_EQ(said_.find("no floor"), std::string::npos) << said_;
  runReportTool(options_);
  EXPECT_NE(read(options_.output + "/index.html").find("yard: floor of the ground truth 0.0250"),
            std::string::npos);
}

TEST_F(ReportFloorTest, IsThereForImportsWhoseDataSetsAreNamed) {
  options_.runs.clear();
  options_.root = folder_.file("root");
  options_.imports = {addFile("mine_yard_local.csv", "id,error\n50,0.3\n")};
  EXPECT_NEAR(*pcrb::parseDouble(floorRow().at("floor")), 0.025, 1e-9);
}

TEST_F(ReportFloorTest, IsMissedAloudWhereTheCloudsAreNotThere) {
  options_.runs.clear();
  options_.imports = {addFile("mine_yard_local.csv", "id,error\n50,0.3\n")};
  EXPECT_EQ(floorRow().at("floor"), "");
  EXPECT_NE(said_.find("truth.csv: no floor"), std::string::npos) << said_;
  EXPECT_NE(said_.find("own/yard"), std::string::npos) << said_;
}

TEST_F(ReportFloorTest, RefusesAGroundTruthOfNoSequenceOfTheResultsAndNamesRowsOfOthers) {
  options_.ground_truth = addFile("truth.csv", kHeader + "eth,yard,0.05,0.02\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, writeReportData(options_),
                    "truth.csv: found only eth/yard, expected a sequence of the results: own/yard");
  options_.ground_truth = addFile("truth.csv", kHeader);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, writeReportData(options_), "truth.csv: found no row");
  options_.ground_truth = addFile("truth.csv", kHeader + "eth,yard,1,0\nown,yard,0.05,0.02\n");
  EXPECT_EQ(floorRow().at("sequence"), "yard");
  EXPECT_NE(said_.find("truth.csv: not in the results, so not shown: eth/yard"), std::string::npos)
      << said_;
}

TEST_F(ReportFloorTest, HasBesideItAxisErrorsThatAreMarkedWhereTheyLeaveTheAxis) {
  runReportTool(options_);
  const std::string page = read(options_.output + "/index.html");
  EXPECT_NE(page.find("class=\"beyond\" data-method=\"run\">◂ -2.00</text>"), std::string::npos);
  EXPECT_NE(page.find("class=\"beyond\" data-method=\"run\">2.00 ▸</text>"), std::string::npos);
}

}  // namespace
}  // namespace pcrb_tools
