#include "pcrb_core/io/pcd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <random>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "support/pcd_text.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

using pcrb_test::parsePcd;
using pcrb_test::PcdText;
using Points = std::vector<Eigen::Vector3d>;

const Points kTwoPoints = {{1, 2, 3}, {4, 5, 6}};

template <typename Value>
std::string bytesOf(std::initializer_list<Value> values) {
  return {reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(Value)};
}

std::string bytesOf(const Points& points) {
  return {reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Points::value_type)};
}

/// A cloud of a few hundred kilobytes, which several threads share.
DatasetCloud largeCloud() {
  std::mt19937_64 bits(5);
  DatasetCloud cloud;
  const auto coordinate = [&] { return std::ldexp(static_cast<double>(bits() >> 11), -46) - 60.0; };
  for (int i = 0; i < 10000; ++i) {
    cloud.points.emplace_back(coordinate(), coordinate(), coordinate());
  }
  return cloud;
}

TEST(Pcd, ReadsAscii) {
  const DatasetCloud cloud = parsePcd(PcdText().text());
  EXPECT_EQ(cloud.points, kTwoPoints);
  EXPECT_TRUE(cloud.intensity.empty());
  EXPECT_FALSE(cloud.hasViewpoint());
  EXPECT_EQ(cloud.dropped_non_finite, 0u);
}

TEST(Pcd, ReadsCrlfAMissingFinalNewlineAndEmptyLinesAtTheEnd) {
  std::string text = PcdText().text();
  EXPECT_EQ(parsePcd(text.substr(0, text.size() - 1)).points, kTwoPoints);
  EXPECT_EQ(parsePcd(text + "\n \r\n").points, kTwoPoints);
  for (std::size_t end = 0; (end = text.find('\n', end)) != std::string::npos; end += 2) {
    text.replace(end, 1, "\r\n");
  }
  EXPECT_EQ(parsePcd(text).points, kTwoPoints);
  EXPECT_EQ(parsePcd(text.substr(0, text.size() - 1)).points, kTwoPoints);
}

TEST(Pcd, ReadsRowsWithAnyBlanks) {
  PcdText pcd;
  pcd.body = "  1\t2  3 \n\t4 5 6\t\n";
  EXPECT_EQ(parsePcd(pcd.text()).points, kTwoPoints);
}

TEST(Pcd, ReadsHeadersWithCommentsAndWithoutOptionalEntries) {
  const std::string text =
      "# comment\n\nFIELDS x y z\n# more\nTYPE F F F\nSIZE 4 4 4\nHEIGHT 1\nWIDTH 2\nPOINTS 2\n"
      "DATA ascii\n1 2 3\n4 5 6\n";
  EXPECT_EQ(parsePcd(text).points, kTwoPoints);
}

TEST(Pcd, ReadsOrganizedCloudsAndDropsNonFinitePoints) {
  PcdText pcd;
  pcd.height = "2";
  pcd.points = "4";
  pcd.body = "nan nan nan\n1 2 3\n4 5 6\n7 inf 8\n";
  const DatasetCloud cloud = parsePcd(pcd.text());
  EXPECT_EQ(cloud.points, kTwoPoints);
  EXPECT_EQ(cloud.dropped_non_finite, 2u);
}

TEST(Pcd, ReadsExtraAndPaddingFieldsInAnyOrder) {
  PcdText pcd{"label z _ histogram y intensity x", "2 4 1 4 8 4 4", "I F U F F F F",
              "1 1 3 2 1 1 1"};
  pcd.body = "-7 3 a b c 0.5 nan 2 0.25 1\n8 6 0 0 0 1 1 5 0.75 4\n";
  const DatasetCloud cloud = parsePcd(pcd.text());
  EXPECT_EQ(cloud.points, kTwoPoints);
  EXPECT_EQ(cloud.intensity, (std::vector<float>{0.25f, 0.75f}));
}

TEST(Pcd, TakesAnyTextInAColumnThatIsNotUsed) {
  for (const std::string value : {"256", "-1", "5.0", "nan", "x"}) {
    PcdText pcd{"x y z i", "4 4 4 1", "F F F U", "1 1 1 1"};
    pcd.body = "1 2 3 " + value + "\n4 5 6 7\n";
    const DatasetCloud cloud = parsePcd(pcd.text());
    EXPECT_EQ(cloud.points, kTwoPoints) << value;
    EXPECT_EQ(cloud.notes.size(), value == "256" ? 0u : 1u) << value;
  }
}

using Notes = std::vector<std::string>;

TEST(Pcd, TakesWithANoteWhatChangesNoCoordinate) {
  const auto expectNote = [](const PcdText& pcd, const std::string& note) {
    const DatasetCloud cloud = parsePcd(pcd.text());
    EXPECT_EQ(cloud.points, kTwoPoints) << note;
    EXPECT_EQ(cloud.notes, Notes{note});
  };
  PcdText pcd;
  EXPECT_EQ(parsePcd(pcd.text()).notes, Notes{});
  pcd.fields = "x Y z";
  expectNote(pcd, "field Y is taken for y");
  pcd = {};
  pcd.viewpoint = "0 0 0 0 0 0 0";
  expectNote(pcd, "VIEWPOINT has only zeros: the sensor's pose is taken as unknown");
  EXPECT_FALSE(parsePcd(pcd.text()).hasViewpoint());
  pcd = {};
  pcd.body = "\n1 2 3\n \t\r\n4 5 6\n";
  expectNote(pcd, "2 blank lines");
  pcd = {"x y z intensity", "4 4 4 4", "F F F F", "1 1 1 4"};
  pcd.body = "1 2 3 9 9 9 9\n4 5 6 9 9 9 9\n";
  expectNote(pcd, "intensity has COUNT 4: it is not kept");
  EXPECT_TRUE(parsePcd(pcd.text()).intensity.empty());
  std::string text = PcdText().text();
  text.erase(text.find("HEIGHT"), 9);
  EXPECT_EQ(parsePcd(text).points, kTwoPoints);
  EXPECT_EQ(parsePcd(text).notes, Notes{"no HEIGHT: it is taken as 1"});
}

TEST(Pcd, TakesIntensityInCapitalsAndAsAnyNumber) {
  PcdText pcd{"X Y Z Intensity", "4 4 4 1", "F F F U", "1 1 1 1"};
  pcd.body = "1 2 3 7.5\n4 5 6 -1\n";
  const DatasetCloud cloud = parsePcd(pcd.text());
  EXPECT_EQ(cloud.points, kTwoPoints);
  EXPECT_EQ(cloud.intensity, (std::vector<float>{7.5f, -1.0f}));
  EXPECT_EQ(cloud.notes.size(), 4u);
  // A field of the very name goes before one in capitals.
  pcd.fields = "x y z Y";
  pcd.body = "1 2 3 8\n4 5 6 9\n";
  EXPECT_EQ(parsePcd(pcd.text()).points, kTwoPoints);
  EXPECT_TRUE(parsePcd(pcd.text()).notes.empty());
}

TEST(Pcd, KeepsTheIntensityOfThePointsThatStay) {
  PcdText pcd{"x y z intensity", "4 4 4 2", "F F F U", "1 1 1 1", "3"};
  pcd.points = "3";
  pcd.body = "1 2 3 10\nnan 0 0 20\n4 5 6 65535\n";
  EXPECT_EQ(parsePcd(pcd.text()).intensity, (std::vector<float>{10, 65535}));
}

TEST(Pcd, ReadsBinaryFloatsDoublesIntegersAndPadding) {
  PcdText pcd{"x _ y z intensity", "8 1 4 8 1", "F U F F I", "1 3 1 1 1"};
  pcd.data = "binary";
  pcd.body = bytesOf({8045123.123456789}) + "abc" + bytesOf({2.5f}) + bytesOf({-3.0}) + "\x05" +
             bytesOf({1.0}) + "\n\r\n" + bytesOf({std::nanf("")}) + bytesOf({0.0}) + "\x06";
  const DatasetCloud cloud = parsePcd(pcd.text());
  EXPECT_EQ(cloud.points, (Points{{8045123.123456789, 2.5, -3.0}}));
  EXPECT_EQ(cloud.intensity, (std::vector<float>{5}));
  EXPECT_EQ(cloud.dropped_non_finite, 1u);
}

TEST(Pcd, ReadsCompressedDataWithAndWithoutItsPadding) {
  const std::string x = bytesOf({1.0f, 4.0f});
  const std::string yz = bytesOf({2.0f, 5.0f, 3.0f, 6.0f});
  PcdText pcd{"x _ y z", "4 1 4 4", "F U F F", "1 2 1 1"};
  pcd.data = "binary_compressed";
  pcd.body = bytesOf<std::uint32_t>({25, 24}) + char(23) + x + yz;
  EXPECT_EQ(parsePcd(pcd.text()).points, kTwoPoints);
  pcd.body = bytesOf<std::uint32_t>({29, 28}) + char(27) + x + "abcd" + yz;
  EXPECT_EQ(parsePcd(pcd.text()).points, kTwoPoints);
}

TEST(Pcd, SaysWhatAPackedCloudTakesBeforeItIsUnpacked) {
  PcdText pcd;
  pcd.points = pcd.width = "1000000";
  pcd.body = bytesOf<std::uint32_t>({140000, 12000000});
  EXPECT_EQ(memoryOfPackedPcd(pcd.text()), 0u);  // DATA ascii
  pcd.data = "binary_compressed";
  EXPECT_EQ(memoryOfPackedPcd(pcd.text()), 12000000u + 2 * 24000000u);
  pcd.points = pcd.width = "1000000000000";  // a lie: no more points than bytes
  EXPECT_EQ(memoryOfPackedPcd(pcd.text()), 12000000u * (1 + 2 * 24));
  EXPECT_EQ(memoryOfPackedPcd("no PCD\n"), 0u);
  const pcrb_test::TemporaryFolder folder;
  EXPECT_EQ(memoryOfPackedPcdFile(folder.file("none.pcd")), 0u);
  std::ofstream(folder.file("a.pcd"), std::ios::binary) << pcd.text();
  EXPECT_EQ(memoryOfPackedPcdFile(folder.file("a.pcd")), memoryOfPackedPcd(pcd.text()));
}

TEST(Pcd, IgnoresZerosThatFillUpAPage) {
  PcdText pcd;
  pcd.data = "binary";
  pcd.body = bytesOf({1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f}) + std::string(4095, '\0');
  EXPECT_EQ(parsePcd(pcd.text()).points, kTwoPoints);
  EXPECT_NE(pcrb_test::pcdError(pcd.text() + std::string(1, '\0')), "no error");
}

TEST(Pcd, ReadsACloudWithoutPoints) {
  PcdText pcd;
  pcd.width = pcd.points = "0";
  pcd.body = "";
  for (const std::string data : {"ascii", "binary"}) {
    pcd.data = data;
    EXPECT_TRUE(parsePcd(pcd.text()).points.empty());
  }
}

TEST(Pcd, ViewpointIsTheSensorsPose) {
  PcdText pcd;
  pcd.viewpoint = "1 2 3 0 0 0 1";  // half a turn about z
  const DatasetCloud cloud = parsePcd(pcd.text());
  ASSERT_TRUE(cloud.hasViewpoint());
  EXPECT_LT((cloud.viewpoint * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, 2, 3)).norm(), 1e-15);
}

TEST(Pcd, IdentityIsTheSensorsPoseWhereTheConverterSaysSo) {
  const pcrb_test::TemporaryFolder folder;
  DatasetCloud cloud;
  cloud.points = {{1, 2, 3}};
  writePcd(folder.file("unknown.pcd"), cloud);
  EXPECT_FALSE(readPcd(folder.file("unknown.pcd")).hasViewpoint());
  cloud.is_viewpoint_known = true;
  writePcd(folder.file("known.pcd"), cloud);
  EXPECT_TRUE(readPcd(folder.file("known.pcd")).hasViewpoint());
  writePcd(folder.file("again.pcd"), readPcd(folder.file("known.pcd")));
  EXPECT_TRUE(readPcd(folder.file("again.pcd")).hasViewpoint());
}

TEST(Pcd, ViewpointIsReadWithoutThePoints) {
  const pcrb_test::TemporaryFolder folder;
  PcdText pcd;
  pcd.viewpoint = "1 2 3 0 0 0 1";
  pcd.body = "no point at all";
  const std::string path = folder.file("a.pcd");
  writeFileAtomically(path, pcd.text());
  ASSERT_TRUE(readViewpoint(path));
  EXPECT_EQ(readViewpoint(path)->translation(), Eigen::Vector3d(1, 2, 3));
  pcd.viewpoint = "0 0 0 1 0 0 0";
  writeFileAtomically(path, pcd.text());
  EXPECT_FALSE(readViewpoint(path));
  writeFileAtomically(path, "# VIEWPOINT is the sensor's pose\n" + pcd.text());
  EXPECT_TRUE(readViewpoint(path));
  writeFileAtomically(path, "VERSION 0.7\n");
  EXPECT_THROW(readViewpoint(path), InvalidFile);
  EXPECT_THROW(readViewpoint(folder.file("none.pcd")), InvalidFile);
}

TEST(Pcd, KeepsTheTimesOfThePointsThatStayIfItIsAsked) {
  const auto times = [](const PcdText& pcd) {
    const std::string text = pcd.text();
    const TimedCloud cloud = parseTimedPcd(text.data(), text.data() + text.size(), "a.pcd");
    EXPECT_EQ(cloud.points, parsePcd(text).points);
    return cloud.times;
  };
  PcdText pcd{"x y z t", "4 4 4 4", "F F F U", "1 1 1 1", "3"};
  pcd.points = "3";
  pcd.body = "1 2 3 0\nnan 0 0 20\n4 5 6 50000000\n";
  EXPECT_EQ(times(pcd), (std::vector<double>{0, 0.05}));  // integers are ns
  PcdText binary{"x y z timestamp", "4 4 4 8", "F F F F", "1 1 1 1"};
  binary.data = "binary";
  binary.body = bytesOf({1.0f, 2.0f, 3.0f}) + bytesOf({1.5e9 + 0.25}) +
                bytesOf({4.0f, 5.0f, 6.0f}) + bytesOf({1.5e9 + 0.5});
  EXPECT_EQ(times(binary), (std::vector<double>{1.5e9 + 0.25, 1.5e9 + 0.5}));
  PcdText without{"x y z", "4 4 4", "F F F", "1 1 1"};
  EXPECT_TRUE(times(without).empty());
}

TEST(Pcd, WritesThePublishedForm) {
  const pcrb_test::TemporaryFolder folder;
  DatasetCloud cloud;
  cloud.points = {{8045123.123456789, -0.5, 1e-5}, {1, 2, 3}};
  writePcd(folder.file("a.pcd"), cloud);
  EXPECT_EQ(FileBytes(folder.file("a.pcd")).text(),
            "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
            "TYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n"
            "DATA ascii\n8045123.123456789 -0.5 1e-05\n1 2 3\n");
}

TEST(Pcd, DoublesOfAnyMagnitudeSurviveWritingAndReading) {
  const pcrb_test::TemporaryFolder folder;
  DatasetCloud cloud = largeCloud();
  cloud.points.emplace_back(8045123.123456789, 702345.98765432101, 1e-300);
  cloud.points.emplace_back(-0.0, 1.7976931348623157e308, 4.9406564584124654e-324);
  cloud.viewpoint = makeTransform({8045123.123456789, -1.5, 2}, {0.5, 0.5, -0.5, 0.5});
  writePcd(folder.file("a.pcd"), cloud);
  const DatasetCloud back = readPcd(folder.file("a.pcd"));
  ASSERT_EQ(back.points.size(), cloud.points.size());
  EXPECT_EQ(bytesOf(back.points), bytesOf(cloud.points));  // which tells -0 from 0
  EXPECT_EQ(back.viewpoint.translation(), cloud.viewpoint.translation());
  EXPECT_LT((back.viewpoint.linear() - cloud.viewpoint.linear()).norm(), 1e-15);
}

TEST(Pcd, RefusesToWritePointsThatAreNotFinite) {
  const pcrb_test::TemporaryFolder folder;
  DatasetCloud cloud;
  cloud.points = {{1, std::nan(""), 2}};
  EXPECT_THROW(writePcd(folder.file("a.pcd"), cloud), InvalidFile);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Pcd, ResultAndErrorsDoNotDependOnTheNumberOfThreads) {
  const pcrb_test::TemporaryFolder folder;
  writePcd(folder.file("a.pcd"), largeCloud());
  std::string text(FileBytes(folder.file("a.pcd")).text());
  const DatasetCloud one = parsePcd(text);
  for (const int threads : {2, 3, 7, 1000}) {
    EXPECT_EQ(parsePcd(text, threads).points, one.points) << threads;
  }
  text[text.find('\n', text.size() / 3) - 1] = 'x';
  text[text.find('\n', text.size() - 1000) - 1] = 'x';
  const std::string error = pcrb_test::pcdError(text);
  EXPECT_NE(error.find("x' for field 'z', expected a number"), std::string::npos) << error;
  for (const int threads : {2, 3, 7}) EXPECT_EQ(pcrb_test::pcdError(text, threads), error);
}

TEST(CloudFiles, AreInTheOrderThatAPersonCounts) {
  const std::vector<std::string> expected{
      "1311878220.377686160.pcd", "1311878220.977686160.pcd", "PointCloud0.pcd",
      "PointCloud2.pcd",          "PointCloud10.pcd",         "box_map.pcd",
      "box_met_007.pcd",          "box_met_010.pcd",          "box_met_0100.pcd"};
  std::vector<std::string> names(expected.rbegin(), expected.rend());
  std::sort(names.begin(), names.end(), naturalLess);
  EXPECT_EQ(names, expected);
}

TEST(CloudFiles, OrderIsStrictForNamesThatDifferInZerosOnly) {
  EXPECT_TRUE(naturalLess("a007", "a07"));
  EXPECT_FALSE(naturalLess("a07", "a007"));
  EXPECT_TRUE(naturalLess("a", "a0"));
  EXPECT_FALSE(naturalLess("a1", "a1"));
}

TEST(CloudFiles, FindsOnlyPcdFilesThatAreNotHidden) {
  const pcrb_test::TemporaryFolder folder;
  for (const char* name : {"b10.pcd", "b9.pcd", ".b9.pcd.tmp.pcd", "readme.txt", "x.pcd.yaml"}) {
    std::ofstream(folder.file(name)) << "x";
  }
  EXPECT_EQ(findClouds(folder.path()), (std::vector<std::string>{"b9.pcd", "b10.pcd"}));
  EXPECT_THROW(findClouds(folder.file("absent")), InvalidFile);
}

}  // namespace
}  // namespace pcrb
