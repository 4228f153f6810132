#include "pcrb_core/problem/overlap_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

OverlapMatrix parseMatrix(const std::string& text) {
  return parseOverlapMatrix(text.data(), text.data() + text.size(), "m.txt");
}

std::string errorOf(const std::string& text) {
  try {
    parseMatrix(text);
  } catch (const InvalidFile& error) {
    return error.what();
  }
  return "accepted";
}

TEST(OverlapMatrix, RowIsTheSourceAndColumnTheTarget) {
  const OverlapMatrix matrix =
      parseMatrix("overlap a.pcd b.pcd\r\na.pcd 1.0 0.25\r\nb.pcd 5e-05 1");
  EXPECT_EQ(matrix.names, (std::vector<std::string>{"a.pcd", "b.pcd"}));
  EXPECT_EQ(matrix.at(0, 1), 0.25);
  EXPECT_EQ(matrix.at(1, 0), 5e-05);
}

TEST(OverlapMatrix, ReadsBackWhatItWritesUnknownOverlapsIncluded) {
  OverlapMatrix matrix({"a.pcd", "b.pcd", "c.pcd"});
  matrix.at(0, 1) = 1.0 / 3.0;
  matrix.at(1, 0) = 0.0;
  const pcrb_test::TemporaryFolder folder;
  writeOverlapMatrix(folder.file("m.txt"), matrix);
  EXPECT_EQ(std::string(FileBytes(folder.file("m.txt")).text()),
            "overlap a.pcd b.pcd c.pcd\n"
            "a.pcd 1.0 0.3333333333333333 nan\n"
            "b.pcd 0.0 1.0 nan\n"
            "c.pcd nan nan 1.0\n");
  const OverlapMatrix read = readOverlapMatrix(folder.file("m.txt"));
  EXPECT_EQ(read.names, matrix.names);
  EXPECT_EQ(read.at(0, 1), 1.0 / 3.0);
  EXPECT_TRUE(std::isnan(read.at(2, 0)));
}

TEST(OverlapMatrix, PublishedMatricesAreReadAndWrittenAlike) {
  PCRB_REQUIRE_SHARED_DATA();
  for (const char* name : {"apartment", "pioneer_slam3"}) {
    const std::string path = pcrb_test::sharedData() + "/overlap/" + name + "_overlap.txt";
    const OverlapMatrix matrix = readOverlapMatrix(path);
    EXPECT_EQ(matrix.names.size(), std::string(name) == "apartment" ? 45U : 149U);
    const std::string again = formatOverlapMatrix(matrix);
    const OverlapMatrix read = parseMatrix(again);
    EXPECT_EQ(read.names, matrix.names);
    EXPECT_EQ(read.values, matrix.values);
  }
}

TEST(OverlapMatrix, RejectsMalformedTextsWithTheirLine) {
  EXPECT_EQ(
      errorOf(""),
      "m.txt: found an empty file, expected the header 'overlap' and the names of the clouds");
  EXPECT_EQ(
      errorOf("names a.pcd\na.pcd 1\n"),
      "m.txt:1: found 'names a.pcd', expected the header 'overlap' and the names of the clouds");
  EXPECT_EQ(errorOf("overlap a a\na 1 1\na 1 1\n"),
            "m.txt:1: found 'a' twice, expected every cloud once");
  EXPECT_EQ(errorOf("overlap ../a\n../a 1\n"),
            "m.txt:1: found '../a', expected a file name without folder");
  EXPECT_EQ(errorOf("overlap a b\na 1\nb 0 1\n"),
            "m.txt:2: found 2 fields, expected a name and 2 overlaps");
  EXPECT_EQ(errorOf("overlap a b\nb 0 1\na 1 0\n"),
            "m.txt:2: found row 'b', expected 'a', in the header's order");
  EXPECT_EQ(errorOf("overlap a\na 1.5\n"),
            "m.txt:2: found '1.5', expected an overlap between 0 and 1, or nan");
  EXPECT_EQ(errorOf("overlap a\na -0.1\n"),
            "m.txt:2: found '-0.1', expected an overlap between 0 and 1, or nan");
  EXPECT_EQ(errorOf("overlap a\na 0,5\n"),
            "m.txt:2: found '0,5', expected an overlap between 0 and 1, or nan");
  EXPECT_EQ(errorOf("overlap a b\na 1 0\n"),
            "m.txt:2: found 1 rows, expected 2, as the header has names");
  EXPECT_EQ(errorOf("overlap a\na 1\nb 1\n"),
            "m.txt:3: found one more row, expected 1 rows, as the header has names");
}

}  // namespace
}  // namespace pcrb
