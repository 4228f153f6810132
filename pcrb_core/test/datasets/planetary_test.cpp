#include "pcrb_core/datasets/planetary.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "pcrb_core/error.hpp"
#include "support/decimal_comma.hpp"
#include "support/expect_error.hpp"
#include "support/shared_data.hpp"

namespace pcrb {
namespace {

const char* const kPose =
    "0.818033 -0.564399 -0.110798 10.253338\n"
    "0.571935 0.818601 0.052751 -0.353549\n"
    "\r\n"
    "0.060927 -0.106521 0.992442 0.064736\n"
    "0.000000 0.000000 0.000000 1.000000\n\n\n";

TEST(PlanetaryScan, ReadsPointsSeparatedByBlanks) {
  const SensorScan scan = parsePlanetaryScan("1.5 -2 3e-2\r\n\t4  5\t6 \n\n7 8 9", "a.xyz");
  ASSERT_EQ(scan.points.size(), 3u);
  EXPECT_EQ(scan.points[0], Eigen::Vector3d(1.5, -2, 0.03));
  EXPECT_EQ(scan.points[1], Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(scan.points[2], Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(scan.counts.read, 3u);
}

TEST(PlanetaryScan, CountsLinesWithoutThreeNumbersAndPointsThatAreNotFinite) {
  const SensorScan scan = parsePlanetaryScan(
      "1 2 3\n1 2\n1 2 3 4\n# note\n1,2,3\n1-2 3\nnan 1 2\n1 2 1e999\n", "a.xyz");
  EXPECT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.counts.read, 8u);
  EXPECT_EQ(scan.counts.malformed, 6u);
  EXPECT_EQ(scan.counts.non_finite, 1u);
}

TEST(PlanetaryScan, RejectsAFileWithMoreMalformedLinesThanTheLimit) {
  std::string text = "1 2 3\n";
  for (int i = 0; i < 1000; ++i) text += "1;2;3\n";
  PCRB_EXPECT_ERROR(InvalidFile, parsePlanetaryScan(text, "a.xyz"),
                    "a.xyz: found 1000 of 1001 lines that are no point, expected 'x y z' in all "
                    "but 1 %");
  EXPECT_EQ(parsePlanetaryScan(text, "a.xyz", 1.0).counts.malformed, 1000u);
  text.clear();
  for (int i = 0; i < 2000; ++i) text += i % 100 == 0 ? "1;2;3\n" : "1 2 3\n";
  EXPECT_EQ(parsePlanetaryScan(text, "a.xyz").points.size(), 1980u);
  EXPECT_THROW(parsePlanetaryScan(text, "a.xyz", 0.005), InvalidFile);
}

TEST(PlanetaryScan, RejectsAFileWithoutAnyPoint) {
  PCRB_EXPECT_ERROR(InvalidFile, parsePlanetaryScan("a b\nc d\n", "a.xyz"),
                    "a.xyz: found no line with a point among 2");
  PCRB_EXPECT_ERROR(InvalidFile, parsePlanetaryScan("", "a.xyz"), "a.xyz: ");
}

TEST(PlanetaryPose, RotationIsTheNearestToTheSixDecimals) {
  const Transform T = parsePlanetaryPose(kPose, "a.gt");
  EXPECT_LT((T.linear().transpose() * T.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(T.linear()(0, 1), -0.564399, 2e-6);
  EXPECT_EQ(T.translation(), Eigen::Vector3d(10.253338, -0.353549, 0.064736));
}

TEST(PlanetaryPose, RejectsDefectsNamingTheLine) {
  const auto expectError = [](const std::string& text, const char* message) {
    PCRB_EXPECT_ERROR(InvalidFile, parsePlanetaryPose(text, "a.gt"), message);
  };
  expectError("1 0 0 0\n0 1 0\n", "a.gt:2: found 3 numbers");
  expectError("1 0 0 0\n0 1 0 0\n0 0 1 0\n", "a.gt: found 3 rows");
  expectError("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n0 0 0 1\n", "a.gt:5: found a fifth row");
  expectError("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 2\n", "0 0 0 1");
  expectError("1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n", "a rotation");
  expectError("1 0 0 0\n0 1 0 x\n", "a.gt:2: found '0 1 0 x'");
  expectError("1 0 0 0\n0 1 0 nan\n", "a.gt:2: found a number that is not finite");
}

TEST(PlanetaryPose, IsReadAlikeUnderALocaleWithDecimalComma) {
  const pcrb_test::DecimalComma comma;
  EXPECT_EQ(parsePlanetaryPose(kPose, "a.gt").translation().x(), 10.253338);
}

TEST(PlanetaryPose, ReadsARealFile) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string path = pcrb_test::sharedData() + "/planetary/p2at_met_001/p2at_met_001.gt";
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const Transform T = parsePlanetaryPose(text, path);
  EXPECT_EQ(T.translation(), Eigen::Vector3d(10.253338, -0.353549, 0.064736));
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-14);
}

TEST(PlacedScan, EqualsANaiveComputation) {
  const Transform T = parsePlanetaryPose(kPose, "a.gt");
  const DatasetCloud cloud = placeScan(parsePlanetaryScan("12.5 -7.25 0.75\n", "a.xyz"), T);
  for (int row = 0; row < 3; ++row) {
    const double naive = T(row, 0) * 12.5 + T(row, 1) * -7.25 + T(row, 2) * 0.75 + T(row, 3);
    EXPECT_NEAR(cloud.points.at(0)[row], naive, 1e-12);
  }
  EXPECT_TRUE(cloud.viewpoint.isApprox(T, 1e-14));
}

}  // namespace
}  // namespace pcrb
