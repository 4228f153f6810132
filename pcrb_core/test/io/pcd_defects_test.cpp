#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "support/expect_error.hpp"
#include "support/pcd_text.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

using pcrb_test::PcdText;

/// What the reader says about a good file after a change.
std::string errorAfter(const std::function<void(PcdText&)>& change) {
  PcdText pcd;
  change(pcd);
  return pcrb_test::pcdError(pcd.text());
}

std::string errorOfBody(const std::string& body) {
  return errorAfter([&](PcdText& pcd) { pcd.body = body; });
}

/// A good file without the line that begins with an entry.
std::string errorWithout(const std::string& entry) {
  std::string text = PcdText().text();
  const std::size_t begin = text.find("\n" + entry) + 1;
  return pcrb_test::pcdError(text.erase(begin, text.find('\n', begin) + 1 - begin));
}

/// A good file with another line before DATA.
std::string errorWithLine(const std::string& line) {
  std::string text = PcdText().text();
  return pcrb_test::pcdError(text.insert(text.find("DATA"), line + "\n"));
}

TEST(PcdDefect, TheUnchangedFileIsGood) {
  EXPECT_EQ(errorAfter([](PcdText&) {}), "no error");
}

TEST(PcdDefect, RejectsAMissingFile) {
  const pcrb_test::TemporaryFolder folder;
  EXPECT_THROW(readPcd(folder.file("none.pcd")), InvalidFile);
}

TEST(PcdDefect, RejectsAnEmptyFile) {
  EXPECT_EQ(pcrb_test::pcdError(""),
            "a.pcd: found an empty file, expected a PCD header that ends with a DATA entry");
}

TEST(PcdDefect, RejectsAHeaderThatIsCutOff) {
  EXPECT_EQ(
      pcrb_test::pcdError("VERSION 0.7\nFIELDS x y z\n"),
      "a.pcd:2: found the end of the file, expected a PCD header that ends with a DATA entry");
}

TEST(PcdDefect, RejectsAnotherFormat) {
  EXPECT_EQ(pcrb_test::pcdError("ply\nformat ascii 1.0\n"),
            "a.pcd:1: found 'ply', expected a PCD header entry");
}

TEST(PcdDefect, RejectsAMissingEntry) {
  for (const std::string entry : {"WIDTH", "POINTS", "SIZE", "TYPE"}) {
    EXPECT_EQ(errorWithout(entry), "a.pcd:9: found no " + entry + ", expected it before DATA");
  }
  EXPECT_EQ(errorWithout("FIELDS"),
            "a.pcd:2: found SIZE without FIELDS before it, expected FIELDS first");
}

TEST(PcdDefect, RejectsAnEntryTwice) {
  EXPECT_EQ(errorWithLine("POINTS 2"), "a.pcd:10: found POINTS again, expected it once");
  EXPECT_EQ(errorWithLine("COLUMNS x y z"), "a.pcd:10: found FIELDS again, expected it once");
}

TEST(PcdDefect, RejectsAnUnknownEntry) {
  EXPECT_EQ(errorWithLine("COLOR red"), "a.pcd:10: found 'COLOR', expected a PCD header entry");
}

TEST(PcdDefect, RejectsANewerVersion) {
  std::string text = PcdText().text();
  EXPECT_EQ(pcrb_test::pcdError(text.replace(8, 3, "0.8")),
            "a.pcd:1: found version '0.8', expected 0.7 or an older one");
}

TEST(PcdDefect, RejectsACloudWithoutCoordinates) {
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.fields = "x y intensity"; }),
            "a.pcd:2: found no field z, expected fields x, y and z");
}

TEST(PcdDefect, RejectsACoordinateTwice) {
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.fields = "x y z x"; }),
            "a.pcd:2: found x again, expected it once");
}

TEST(PcdDefect, RejectsEntriesThatDoNotMatchTheFields) {
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.size = "4 4"; }),
            "a.pcd:3: found 2 values for SIZE, expected 3, one for each field");
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.type = "F F F F"; }),
            "a.pcd:4: found 4 values for TYPE, expected 3, one for each field");
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.count = ""; }),
            "a.pcd:5: found 0 values for COUNT, expected 3, one for each field");
}

TEST(PcdDefect, RejectsImpossibleSizesTypesAndCounts) {
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.size = "4 3 4"; }),
            "a.pcd:3: found size '3', expected 1, 2, 4 or 8 bytes");
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.type = "F D F"; }),
            "a.pcd:4: found type 'D', expected F, I or U");
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.count = "1 0 1"; }),
            "a.pcd:5: found count '0', expected 1 to 2147483647");
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.count = "1 9999999999 1"; }),
            "a.pcd:5: found count '9999999999', expected 1 to 2147483647");
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.size = "4 2 4"; }),
            "a.pcd:10: found type F, size 2, count 1 for field 'y', expected size 4 or 8");
}

TEST(PcdDefect, RejectsCoordinatesThatAreNoSingleFloat) {
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.type = "F F I"; }),
            "a.pcd:10: found type I, size 4, count 1 for field 'z', expected type F");
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.count = "1 1 2"; }),
            "a.pcd:10: found type F, size 4, count 2 for field 'z', expected count 1");
}

TEST(PcdDefect, RejectsNumbersOfPointsThatAreNone) {
  for (const std::string value : {"abc", "-1", "2.0", "99999999999999999999"}) {
    EXPECT_EQ(errorAfter([&](PcdText& pcd) { pcd.points = value; }),
              "a.pcd:9: found '" + value + "' for POINTS, expected a whole number");
  }
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.width = "1 2"; }),
            "a.pcd:6: found 2 values for WIDTH, expected 1");
}

TEST(PcdDefect, RejectsPointsThatAreNotWidthTimesHeight) {
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.points = "3"; }),
            "a.pcd:10: found WIDTH 2, HEIGHT 1 and POINTS 3, expected WIDTH * HEIGHT = POINTS");
}

TEST(PcdDefect, RejectsAProductThatOverflows) {
  const std::string error = errorAfter([](PcdText& pcd) {
    pcd.width = "4294967297";  // times the height: 2 modulo 2^64
    pcd.height = "18446744069414584322";
  });
  EXPECT_NE(error.find("expected WIDTH * HEIGHT = POINTS"), std::string::npos) << error;
}

TEST(PcdDefect, RejectsViewpointsThatAreNoPose) {
  EXPECT_EQ(
      errorAfter([](PcdText& pcd) { pcd.viewpoint = "0 0 0 1 0 0"; }),
      "a.pcd:8: found 6 values for VIEWPOINT, expected 7: translation and quaternion w x y z");
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.viewpoint = "0 0 nan 1 0 0 0"; }),
            "a.pcd:8: found 'nan', expected a finite number");
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.viewpoint = "0 0 1 0 0 0 0"; }),
            "a.pcd:8: found a quaternion of norm 0, expected a unit quaternion");
}

TEST(PcdDefect, RejectsAnUnknownEncoding) {
  EXPECT_EQ(errorAfter([](PcdText& pcd) { pcd.data = "base64"; }),
            "a.pcd:10: found data 'base64', expected ascii, binary or binary_compressed");
}

TEST(PcdDefect, RejectsTextInsteadOfANumber) {
  EXPECT_EQ(errorOfBody("1 2 3\n4 abc 6\n"),
            "a.pcd:12: found 'abc' for field 'y', expected a number");
  EXPECT_EQ(errorOfBody("1 2 3\n4 5 6x\n"),
            "a.pcd:12: found '6x' for field 'z', expected a number");
  EXPECT_EQ(errorOfBody("1 2 3\n4 5,5 6\n"),
            "a.pcd:12: found '5,5' for field 'y', expected a number");
}

TEST(PcdDefect, RejectsAShortRow) {
  EXPECT_EQ(errorOfBody("1 2\n4 5 6\n"), "a.pcd:11: found 2 values, expected 3");
}

TEST(PcdDefect, RejectsALongRow) {
  EXPECT_EQ(errorOfBody("1 2 3\n4 5 6 7\n"), "a.pcd:12: found 4 values, expected 3");
}

TEST(PcdDefect, RejectsARowThatIsCutByACarriageReturn) {
  EXPECT_NE(errorOfBody("1 2 3\r4 5 6\n"), "no error");
}

TEST(PcdDefect, RejectsTooFewRows) {
  EXPECT_EQ(errorOfBody("1 2 3\n"), "a.pcd:11: found 1 rows of points, expected 2 as POINTS says");
  EXPECT_EQ(errorOfBody(""), "a.pcd:10: found 0 rows of points, expected 2 as POINTS says");
}

TEST(PcdDefect, RejectsTooManyRows) {
  EXPECT_EQ(errorOfBody("1 2 3\n4 5 6\n7 8 9\n"),
            "a.pcd:13: found 3 rows of points, expected 2 as POINTS says");
}

TEST(PcdDefect, RefusesACloudBeyondTheMemoryBeforeItIsThere) {
  const std::size_t points = 100000;
  const auto parse = [&](const std::string& data, std::size_t memory) {
    PcdText pcd;
    pcd.width = pcd.points = std::to_string(points);
    pcd.data = data;
    pcd.body = std::string(data == "binary" ? 12 * points : 0, '\0');
    for (std::size_t i = 0; data == "ascii" && i < points; ++i) pcd.body += "0 0 0\n";
    const std::string text = pcd.text();
    MemoryBudget budget(memory);
    PcdReadOptions options;
    options.budget = &budget;
    return pcrb::parsePcd(text.data(), text.data() + text.size(), "a.pcd", options).points.size();
  };
  for (const std::string data : {"ascii", "binary"}) {
    EXPECT_EQ(parse(data, 4000000), points) << data;
    pcrb_test::expectError<InvalidFile>([&] { parse(data, 2000000); },
                                        "of memory, expected at most 2 MB (--memory)");
  }
}

TEST(PcdDefect, RefusesACompressedBombBeforeItIsThere) {
  // Two bytes and copies of 264 bytes from three each stand for 88 times their size.
  std::string lzf("\0a", 2);
  while (lzf.size() < 30000) lzf += std::string("\xe0\xff\0", 3);
  const std::uint32_t sizes[2] = {static_cast<std::uint32_t>(lzf.size()),
                                  static_cast<std::uint32_t>(1 + (lzf.size() - 2) / 3 * 264)};
  PcdText pcd;
  pcd.width = pcd.points = std::to_string(sizes[1] / 12);
  pcd.data = "binary_compressed";
  pcd.body = std::string(reinterpret_cast<const char*>(sizes), sizeof(sizes)) + lzf;
  const std::string text = pcd.text();
  MemoryBudget budget(1000000);
  PcdReadOptions options;
  options.budget = &budget;
  pcrb_test::expectError<InvalidFile>(
      [&] { pcrb::parsePcd(text.data(), text.data() + text.size(), "a.pcd", options); },
      "a.pcd:10: found a cloud that takes 8 MB of memory, expected at most 1 MB (--memory)");
}

TEST(PcdDefect, LyingPointCountsCostNoMemory) {
  const std::string lie = "1000000000000000000";
  const std::string compressed = std::string("\x19\0\0\0\x18\0\0\0\x17", 9) + std::string(24, 'a');
  const auto errorOf = [&](const std::string& data, const std::string& body) {
    return errorAfter([&](PcdText& pcd) {
      pcd.width = pcd.points = lie;
      pcd.data = data;
      pcd.body = body;
    });
  };
  EXPECT_EQ(errorOf("ascii", "1 2 3\n"),
            "a.pcd:11: found 1 rows of points, expected " + lie + " as POINTS says");
  EXPECT_EQ(errorOf("binary", std::string(24, 'a')),
            "a.pcd:10: found 24 bytes of data, expected " + lie + " points of 12 bytes");
  EXPECT_EQ(
      errorOf("binary_compressed", compressed),
      "a.pcd:10: found 24 bytes of uncompressed data, expected " + lie + " points of 12 bytes");
}

TEST(PcdDefect, LyingFieldCountsCostNoMemory) {
  for (const std::string data : {"ascii", "binary", "binary_compressed"}) {
    const PcdText pcd{"x y z _",       "4 4 4 8", "F F F U", "1 1 1 2147483647", "2", "1",
                      "0 0 0 1 0 0 0", "2",       data};
    EXPECT_NE(pcrb_test::pcdError(pcd.text()), "no error");
  }
}

TEST(PcdDefect, RejectsBinaryDataOfAnotherSize) {
  const auto errorOf = [](const std::string& body) {
    return errorAfter([&](PcdText& pcd) {
      pcd.data = "binary";
      pcd.body = body;
    });
  };
  EXPECT_EQ(errorOf(std::string(24, 'a')), "no error");
  EXPECT_EQ(errorOf(std::string(23, 'a')),
            "a.pcd:10: found 23 bytes of data, expected 2 points of 12 bytes");
  EXPECT_EQ(errorOf(std::string(36, 'a')),
            "a.pcd:10: found 36 bytes of data, expected 2 points of 12 bytes");
}

TEST(PcdDefect, RejectsBrokenCompressedData) {
  const auto errorOf = [](unsigned char compressed, unsigned char uncompressed,
                          const std::string& lzf) {
    const auto size = [](unsigned char value) {
      return std::string{static_cast<char>(value), 0, 0, 0};
    };
    return errorAfter([&](PcdText& pcd) {
      pcd.data = "binary_compressed";
      pcd.body = size(compressed) + size(uncompressed) + lzf;
    });
  };
  const std::string good = char(23) + std::string(24, 'a');
  EXPECT_EQ(errorOf(25, 24, good), "no error");
  EXPECT_EQ(errorOf(26, 24, good),
            "a.pcd:10: found 25 bytes of compressed data, expected 26 bytes");
  EXPECT_EQ(errorOf(25, 24, good + "x"),
            "a.pcd:10: found 26 bytes of compressed data, expected 25 bytes");
  EXPECT_EQ(errorOf(24, 24, good.substr(0, 24)),
            "a.pcd:10: found broken LZF data, expected 24 bytes after decoding");
  EXPECT_EQ(errorOf(25, 23, good),
            "a.pcd:10: found broken LZF data, expected 23 bytes after decoding");
  EXPECT_EQ(errorOf(13, 12, char(11) + std::string(12, 'a')),
            "a.pcd:10: found 12 bytes of uncompressed data, expected 2 points of 12 bytes");
  EXPECT_EQ(errorOf(1, 89, "x"),
            "a.pcd:10: found 89 bytes claimed to be in 1 bytes of LZF data, expected at most 88 "
            "times as many");
  EXPECT_EQ(errorAfter([](PcdText& pcd) {
              pcd.data = "binary_compressed";
              pcd.body = "1234567";
            }),
            "a.pcd:10: found 7 bytes of data, expected 8 bytes with two sizes");
}

TEST(PcdDefect, RejectsCompressedDataThatReadsOrWritesOutside) {
  const auto is_broken = [](const std::string& lzf, unsigned char uncompressed) {
    const std::string message = errorAfter([&](PcdText& pcd) {
      pcd.data = "binary_compressed";
      pcd.body = std::string{static_cast<char>(lzf.size()), 0, 0, 0} +
                 std::string{static_cast<char>(uncompressed), 0, 0, 0} + lzf;
    });
    return message.find("broken LZF data") != std::string::npos;
  };
  EXPECT_FALSE(is_broken(std::string("\0a\x60\0", 4), 6));    // a literal and a copy
  EXPECT_TRUE(is_broken(std::string("\x02") + "ab", 3));      // literal cut off
  EXPECT_TRUE(is_broken(std::string("\x02") + "abc", 2));     // literal too long
  EXPECT_TRUE(is_broken(std::string("\0a\x20", 3), 4));       // copy cut off
  EXPECT_TRUE(is_broken(std::string("\0a\xe0", 3), 10));      // length cut off
  EXPECT_TRUE(is_broken(std::string("\0a\xe0\x01", 4), 11));  // distance cut off
  EXPECT_TRUE(is_broken(std::string("\0a\x20\x01", 4), 4));   // from before the start
  EXPECT_TRUE(is_broken(std::string("\0a\x20\0", 4), 3));     // copy too long
  EXPECT_TRUE(is_broken(std::string("\0a", 2), 2));           // too little
}

TEST(PcdDefect, RejectsLessThanOneThread) {
  EXPECT_THROW(pcrb_test::parsePcd(PcdText().text(), 0), InvalidParameter);
}

}  // namespace
}  // namespace pcrb
