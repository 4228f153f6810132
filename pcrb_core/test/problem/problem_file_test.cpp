#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

namespace fs = std::filesystem;

const std::string kHeader = "id source target overlap t1 t2 t3 t4 t5 t6 t7 t8 t9 t10 t11 t12\n";
const std::string kRow =
    "34562489690000 a.pcd b.pcd 0.4035 1 0 0 684738.3277612422 0 1 0 -2 0 0 1 3\n";

std::vector<Problem> parseProblems(const std::string& text) {
  return parseProblemFile(text.data(), text.data() + text.size(), "file.txt");
}

/// What the reader says about a text; "no error" if it takes it.
std::string messageForFile(const std::string& text) {
  try {
    parseProblems(text);
  } catch (const InvalidFile& error) {
    return error.what();
  }
  return "no error";
}

/// kRow with one of its 16 fields replaced.
std::string rowWith(std::size_t field, const std::string& value) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < field; ++i) begin = kRow.find(' ', begin) + 1;
  return std::string(kRow).replace(begin, kRow.find_first_of(" \n", begin) - begin, value);
}

TEST(ProblemFile, ReadsARow) {
  const auto problems = parseProblems(kHeader + kRow);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].id, "34562489690000");
  EXPECT_EQ(problems[0].source, "a.pcd");
  EXPECT_EQ(problems[0].target, "b.pcd");
  EXPECT_EQ(problems[0].overlap, 0.4035);
  Eigen::Matrix<double, 3, 4> expected;
  expected << 1, 0, 0, 684738.3277612422, 0, 1, 0, -2, 0, 0, 1, 3;
  EXPECT_EQ(problems[0].perturbation, expected);
}

TEST(ProblemFile, ReadsCrlfAndAMissingFinalNewline) {
  const std::string header = kHeader.substr(0, kHeader.size() - 1) + "\r\n";
  const std::string row = kRow.substr(0, kRow.size() - 1);
  EXPECT_EQ(parseProblems(header + row + "\r\n").size(), 1u);
  EXPECT_EQ(parseProblems(kHeader + row).size(), 1u);
}

TEST(ProblemFile, WritesTheOfficialFilesByteForByte) {
  PCRB_REQUIRE_SHARED_DATA();
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(pcrb_test::sharedData())) {
    const std::string folder = entry.path().parent_path().parent_path().filename();
    const bool is_official = entry.path().parent_path().filename() == "official";
    if (entry.path().extension() != ".txt" || (!is_official && folder != "benchmark")) continue;
    const std::string path = entry.path();
    EXPECT_TRUE(formatProblemFile(readProblemFile(path)) == FileBytes(path).text()) << path;
    ++files;
  }
  EXPECT_EQ(files, 10u);
}

TEST(ProblemFile, WrittenFileIsTheText) {
  const pcrb_test::TemporaryFolder folder;
  writeProblemFile(folder.file("p.txt"), parseProblems(kHeader + kRow));
  EXPECT_EQ(FileBytes(folder.file("p.txt")).text(), kHeader + kRow);
}

TEST(ProblemFile, RejectsAnEmptyFile) {
  EXPECT_EQ(messageForFile(""), "file.txt: found an empty file, expected the header '" +
                                    kHeader.substr(0, kHeader.size() - 1) + "'");
}

TEST(ProblemFile, RejectsAnotherHeader) {
  EXPECT_EQ(messageForFile("id source target\n" + kRow),
            "file.txt:1: found 'id source target', expected '" +
                kHeader.substr(0, kHeader.size() - 1) + "'");
  EXPECT_NE(messageForFile(kRow), "no error");
}

TEST(ProblemFile, RejectsAFileWithoutRows) {
  EXPECT_EQ(messageForFile(kHeader),
            "file.txt:1: found no problem, expected at least one row after the header");
}

TEST(ProblemFile, RejectsRowWithElevenTransformEntries) {
  const std::string row = kRow.substr(0, kRow.size() - 3) + "\n";
  EXPECT_EQ(
      messageForFile(kHeader + row),
      "file.txt:2: found 15 fields, expected 16: id, source, target, overlap and 12 transform "
      "entries");
}

TEST(ProblemFile, RejectsRowWithThirteenTransformEntries) {
  const std::string row = kRow.substr(0, kRow.size() - 1) + " 0\n";
  EXPECT_EQ(messageForFile(kHeader + row).substr(0, 28), "file.txt:2: found 17 fields,");
}

TEST(ProblemFile, PassesOverBlankLinesAndCountsThem) {
  EXPECT_EQ(parseProblems("\n" + kHeader + " \t\n" + kRow + "\n").size(), 1u);
  EXPECT_EQ(messageForFile(kHeader + "\nx\n").substr(0, 26), "file.txt:3: found 1 fields");
}

TEST(ProblemFile, RejectsIdsThatAreNoDigits) {
  for (const std::string id : {"3456248969000x", "-3456248969000", "1", "123456789012345678901"}) {
    EXPECT_EQ(messageForFile(kHeader + rowWith(0, id)),
              "file.txt:2: found '" + id + "', expected an id of 2 to 20 decimal digits");
  }
}

TEST(ProblemFile, RejectsAnIdTwice) {
  EXPECT_EQ(messageForFile(kHeader + kRow + kRow),
            "file.txt:3: found id 34562489690000 of line 2 again, expected an id of its own");
}

TEST(ProblemFile, RejectsNamesThatLeaveTheFolder) {
  for (const unsigned field : {1u, 2u}) {
    for (const std::string name : {"../a.pcd", "/a.pcd", "..", "a/b.pcd"}) {
      EXPECT_EQ(messageForFile(kHeader + rowWith(field, name)),
                "file.txt:2: found '" + name +
                    "', expected a file name without folder, blanks or control characters");
    }
    EXPECT_NE(messageForFile(kHeader + rowWith(field, std::string("a\0b", 3))), "no error");
  }
}

TEST(ProblemFile, RejectsImpossibleOverlaps) {
  for (const std::string overlap : {"1.0001", "-0.1"}) {
    EXPECT_EQ(messageForFile(kHeader + rowWith(3, overlap)),
              "file.txt:2: found '" + overlap + "', expected an overlap between 0 and 1");
  }
  EXPECT_EQ(messageForFile(kHeader + rowWith(3, "nan")),
            "file.txt:2: found 'nan' in column overlap, expected a finite number");
}

TEST(ProblemFile, RejectsTransformEntriesThatAreNoFiniteNumber) {
  for (const std::string entry : {"abc", "nan", "inf", "1e400", "1,5", "1.0x"}) {
    EXPECT_EQ(messageForFile(kHeader + rowWith(7, entry)),
              "file.txt:2: found '" + entry + "' in column t4, expected a finite number");
  }
}

TEST(ProblemFile, WritesNoRowThatItWouldNotRead) {
  const Problem good = parseProblems(kHeader + kRow)[0];
  std::vector<Problem> bad(5, good);
  bad[0].id = "x";
  bad[1].source = "a b.pcd";
  bad[2].target = "";
  bad[3].overlap = std::numeric_limits<double>::quiet_NaN();
  bad[4].perturbation(1, 2) = std::numeric_limits<double>::infinity();
  for (const Problem& problem : bad) {
    EXPECT_THROW(formatProblemFile({problem}), InvalidProblem) << problem.id;
  }
}

TEST(ProblemId, AgreesWithThePublishedIds) {
  // First and last rows of the published files, and the second pair of a global list.
  EXPECT_EQ(problemId("plain", 0, 100), "4215528470000");
  EXPECT_EQ(problemId("plain", 3098, 100), "4215528473098");
  EXPECT_EQ(problemId("p2at_met", 30, 100), "27844314100030");
  EXPECT_EQ(problemId("p2at_met", 61, 100), "27844314100061");
  EXPECT_EQ(problemId("planetary_map", 3160, 102), "25528382213160");
  EXPECT_EQ(problemId("urban05", 31, 100), "34562489690031");
}

TEST(ProblemId, HasAsManyIndexDigitsAsTheLastIndex) {
  EXPECT_EQ(problemId("street", 0, 2), "404218364000");
  EXPECT_THROW(problemId("street", 62, 2), InvalidParameter);
  EXPECT_THROW(problemId("street", 0, 0), InvalidParameter);
}

TEST(Kind, NamesRoundTripAndOthersAreRejected) {
  EXPECT_EQ(kindFromString(toString(Kind::kLocal)), Kind::kLocal);
  EXPECT_EQ(kindFromString(toString(Kind::kGlobal)), Kind::kGlobal);
  EXPECT_THROW(kindFromString("Local"), InvalidParameter);
}

}  // namespace
}  // namespace pcrb
