#include <gtest/gtest.h>

#include <filesystem>

#include "conversion/converters.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

const std::string kPose = "0 -1 0 10.5\n1 0 0 -3\n0 0 1 0.25\n0 0 0 1\n\n\n";

PlanetaryRequest requestFor(const pcrb_test::TemporaryFolder& folder, const std::string& input) {
  PlanetaryRequest request;
  request.inputs = {input};
  request.root = folder.file("root");
  return request;
}

pcrb_test::NamedFiles scanFiles(const std::string& stem) {
  return {{stem + "/" + stem + ".xyz", "1.5 2 3\r\n4 5 6\nbroken line\nnan 1 2\n"},
          {stem + "/" + stem + ".gt", kPose}};
}

TEST(PlanetaryConversion, PointsAreMovedByThePoseAndDroppedLinesCounted) {
  const pcrb_test::TemporaryFolder folder;
  pcrb_test::writeFiles(folder.file("box_met"), scanFiles("box_met_052"));
  const ConversionReport report = convertPlanetary(requestFor(folder, folder.file("box_met")));
  EXPECT_EQ(report.sequence, "box_met");
  EXPECT_EQ(report.points.read, 4u);
  EXPECT_EQ(report.points.malformed, 1u);
  EXPECT_EQ(report.points.non_finite, 1u);
  const auto cloud = pcrb::readPcd(folder.file("root/planetary/box_met/box_met_052.pcd"));
  ASSERT_EQ(cloud.points.size(), 2u);
  EXPECT_LT((cloud.points[0] - Eigen::Vector3d(8.5, -1.5, 3.25)).norm(), 1e-6);
  EXPECT_LT((cloud.points[1] - Eigen::Vector3d(5.5, 1.0, 6.25)).norm(), 1e-6);
  EXPECT_LT((cloud.viewpoint.translation() - Eigen::Vector3d(10.5, -3, 0.25)).norm(), 1e-12);
}

TEST(PlanetaryConversion, AScanOfWhichLittleCanBeReadIsRefusedUnlessThatIsAllowed) {
  const pcrb_test::TemporaryFolder folder;
  std::string lines = "1 2 3\n";
  for (int i = 0; i < 1000; ++i) lines += "no point\n";
  auto files = scanFiles("box_met_052");
  for (auto& [name, bytes] : files) {
    if (name.find(".xyz") != std::string::npos) bytes = lines;
  }
  pcrb_test::writeFiles(folder.file("box_met"), files);
  PlanetaryRequest request = requestFor(folder, folder.file("box_met"));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertPlanetary(request),
                    "found 1000 of 1001 lines that are no point, expected 'x y z' in all but 1 % "
                    "(--max-malformed allows more)");
  request.max_malformed = 1.0;
  EXPECT_EQ(convertPlanetary(request).points.written(), 1u);
}

TEST(PlanetaryConversion, ReadsOneArchiveAScan) {
  const pcrb_test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.file("p2at_met"));
  for (const std::string stem : {"p2at_met_001", "p2at_met_010", "p2at_met_002"}) {
    pcrb_test::writeArchive(folder.file("p2at_met/" + stem + ".zip"), scanFiles(stem));
  }
  const ConversionReport report = convertPlanetary(requestFor(folder, folder.file("p2at_met")));
  EXPECT_EQ(report.written,
            (std::set<std::string>{"p2at_met_001.pcd", "p2at_met_002.pcd", "p2at_met_010.pcd"}));
}

TEST(PlanetaryConversion, ARealPoseIsMadeOrthonormalBeforeUse) {
  PCRB_REQUIRE_SHARED_DATA();
  const pcrb_test::TemporaryFolder folder;
  const std::string stem = "p2at_met_001";
  pcrb_test::writeFile(folder.file(stem + ".xyz"), "30 -20 1\n0 0 0\n");
  std::filesystem::copy_file(pcrb_test::sharedData() + "/planetary/" + stem + "/" + stem + ".gt",
                             folder.file(stem + ".gt"));
  convertPlanetary(requestFor(folder, folder.path()));
  const auto cloud = pcrb::readPcd(folder.file("root/planetary/p2at_met/" + stem + ".pcd"));
  // Lengths are kept to rounding, which the six decimals as they are would not do.
  EXPECT_NEAR((cloud.points.at(0) - cloud.points.at(1)).norm(), std::sqrt(1301.0), 1e-12);
  EXPECT_NEAR(cloud.points[0].x(), 0.818033 * 30 + 0.564399 * 20 - 0.110798 + 10.253338, 1e-4);
}

TEST(PlanetaryConversion, AScanWithoutItsPoseIsAnError) {
  const pcrb_test::TemporaryFolder folder;
  pcrb_test::writeFile(folder.file("box_met_001.xyz"), "1 2 3\n");
  pcrb_test::writeFile(folder.file("box_met_002.gt"), kPose);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertPlanetary(requestFor(folder, folder.path())),
                    "box_met_001.xyz: found no pose, expected a file box_met_001.gt");
}

TEST(PlanetaryConversion, ADefectivePoseNamesFileAndLine) {
  const pcrb_test::TemporaryFolder folder;
  pcrb_test::writeFile(folder.file("box_met_001.xyz"), "1 2 3\n");
  pcrb_test::writeFile(folder.file("box_met_001.gt"), "1 0 0 0\n0 1 0\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertPlanetary(requestFor(folder, folder.path())),
                    "box_met_001.gt:2: found 3 numbers");
  EXPECT_FALSE(std::filesystem::exists(folder.file("root")));
}

TEST(PlanetaryConversion, ScansOfTwoSetsAreNotMixed) {
  const pcrb_test::TemporaryFolder folder;
  pcrb_test::writeFiles(folder.path(), scanFiles("box_met_001"));
  pcrb_test::writeFiles(folder.path(), scanFiles("p2at_met_001"));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertPlanetary(requestFor(folder, folder.path())),
                    "scans of one set");
}

TEST(PlanetaryConversion, AScanWithoutAnyPointIsAnErrorWithItsName) {
  const pcrb_test::TemporaryFolder folder;
  pcrb_test::writeFile(folder.file("box_met_001.xyz"), "no point\n");
  pcrb_test::writeFile(folder.file("box_met_001.gt"), kPose);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convertPlanetary(requestFor(folder, folder.path())),
                    "box_met_001.xyz: found no line with a point");
}

}  // namespace
}  // namespace pcrb_tools
